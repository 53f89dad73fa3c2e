// The scan points of a run, frame by frame, before anything is done with them.
#pragma once

#include <cstddef>
#include <string>
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

// The frames with evidence of a capture, cut as the target cuts them (app::Frame): dropped
// packets are not in them. UsageError if the file cannot be read.
[[nodiscard]] std::vector<FramePoints> read_points(const std::string& pcap,
                                                   const tools::CatalogueEntry& car);

// What the scanners of a simulated drive see in that frame.
[[nodiscard]] FramePoints points_of(tools::Drive& drive, std::uint32_t frame,
                                    const tools::CatalogueEntry& car);

}  // namespace iog::lab
