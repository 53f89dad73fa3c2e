// When a packet was measured: the middle of its sweep.
//
// A LUX gives the start and end of its scan, and each message gives the sector that it covers. The
// mirror turns evenly, and the scan reaches as far to the left as to the right. A Velodyne gives
// the start of its packet in microseconds since the hour.
#pragma once

#include <cstdint>

#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

// Microseconds since 1970-01-01 UTC by the sensor's clock. A clock that counts from the hour is
// completed to the time nearest to near_us. Any decoded packet is accepted: a scan that ends before
// it begins counts as taking no time, and one longer than a second as taking a second.
[[nodiscard]] std::uint64_t measured_us(const vehicle::Sensor& sensor,
                                        const lidar::PacketInfo& packet, std::uint64_t near_us);

}  // namespace iog::intake
