// When a packet was measured: in the middle of its sweep.
//
// A LUX says when its scan began and ended, and a message of it which sector it covers; the mirror
// turns evenly, and the scan lies as far to the left as to the right. A Velodyne says when its
// packet began, in microseconds since the hour.
#pragma once

#include <cstdint>

#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

// Microseconds since 1970-01-01 UTC by the sensor's clock. What counts from the hour is completed
// to the time that is nearest to near_us. Any packet that was decoded may come: a scan that ends
// before it begins, or takes more than a second, is taken for one of no time, or of a second.
[[nodiscard]] std::uint64_t measured_us(const vehicle::Sensor& sensor,
                                        const lidar::PacketInfo& packet, std::uint64_t near_us);

}  // namespace iog::intake
