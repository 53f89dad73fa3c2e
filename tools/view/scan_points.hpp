// Where the scan points of a packet lie, for the eye: seen from above, in centimetres.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "vehicle/beam.hpp"

namespace iog::tools::view {

struct SeenPoint {
  std::int16_t x_cm;  // in the vehicle frame
  std::int16_t y_cm;
  vehicle::Fate fate;
};

// Appends the points of a sensor's packet that have a range and lie within 300 m; none if it is not
// a packet of that sensor.
void append_points(const CatalogueEntry& car, const CapturedDatagram& packet,
                   std::vector<SeenPoint>& points);

}  // namespace iog::tools::view
