// Messages of Foxglove as clouds: PointCloud and LaserScan, in Protocol Buffers or in CDR.
// The pose of such a message is not used: its points are in the frame of the sensor, whose place
// the car's file says.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "tools/clouds/cloud_fields.hpp"

namespace iog::tools {

// A message is in CDR, or else in Protocol Buffers. The functions throw a UsageError that begins
// with `what` for one that is cut off.

// Sets unit as cloud_of() does. UsageError as cloud_of().
[[nodiscard]] SeenCloud cloud_of_foxglove(std::span<const std::byte> message, bool is_cdr,
                                          TimeUnit& unit, const std::string& what);
// Beams are evenly apart from the first angle to the last, and have no times. UsageError as
// cloud_of_ranges().
[[nodiscard]] SeenCloud scan_of_foxglove(std::span<const std::byte> message, bool is_cdr,
                                         const std::string& what);
// The name of the frame of a message of either kind.
[[nodiscard]] std::string frame_of_foxglove(std::span<const std::byte> message, bool is_cdr,
                                            const std::string& what);

}  // namespace iog::tools
