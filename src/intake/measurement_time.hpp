// The measurement time of a packet is the middle of its sweep.
//
// A LUX sends the start and the end of a scan, and each message specifies the sector that it
// covers. The mirror rotates at a constant speed, and the scan extends equally far to the left and
// to the right. A Velodyne sends the start of a packet in microseconds since the start of the hour.
#pragma once

#include <cstdint>

#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

// Returns the measurement time in microseconds since 1970-01-01 UTC, on the sensor's clock. If the
// clock counts from the start of the hour, the function adds the hour that brings the result
// closest to near_us. The function accepts any decoded packet. A scan that ends before it begins is
// treated as instantaneous, and a scan that takes longer than one second is treated as one second
// long.
[[nodiscard]] std::uint64_t measured_us(const vehicle::Sensor& sensor,
                                        const lidar::PacketInfo& packet, std::uint64_t near_us);

}  // namespace iog::intake
