// The scan points of a drive, frame by frame, before anything is done with them.
#pragma once

#include <cstddef>
#include <vector>

#include "lidar/scan_point.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {

struct SensorPoint {
  std::size_t sensor;  // place in Vehicle::sensors
  lidar::ScanPoint point;
};

// In the order of arrival.
using FramePoints = std::vector<SensorPoint>;

// What the scanners of a simulated drive see in that frame.
[[nodiscard]] FramePoints points_of(tools::Drive& drive, std::uint32_t frame,
                                    const tools::CatalogueEntry& car);

}  // namespace iog::lab
