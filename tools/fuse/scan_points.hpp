// Where the scan points of a packet lie, for the eye.
#pragma once

#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/vehicles/seen_point.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// Appends the points of a sensor's packet that have a range and lie within 300 m; none if it is not
// a packet of that sensor.
void append_points(const CatalogueEntry& car, const CapturedDatagram& packet,
                   std::vector<SeenPoint>& points);

}  // namespace iog::tools
