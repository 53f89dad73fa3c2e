// How a car's LUX send a frame: their scans on the wire, whatever is in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "tools/formats/capture/datagram.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

inline constexpr std::uint32_t kLuxFramesPerSecond = 25;

// The points of that sensor's scan.
using ScanOfSensor = std::function<std::vector<LuxPoint>(std::size_t sensor)>;

// The datagrams of frame 0, 1, ..., in the order of their times: one burst of all sensors, one
// after another, which begins at the end of their scans. All sensors of the car are LUX.
[[nodiscard]] std::vector<CapturedDatagram> lux_burst(const CatalogueEntry& car,
                                                      std::uint32_t frame,
                                                      const ScanOfSensor& points_of);

}  // namespace iog::tools
