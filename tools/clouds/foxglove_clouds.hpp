// Messages of Foxglove as clouds: PointCloud and LaserScan, in Protocol Buffers or in CDR.
// The pose of such a message is not used: its points are in the frame of the sensor, whose place
// the car's file says.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "tools/clouds/cloud_fields.hpp"

namespace iog::tools {

// UsageError, which begins with `what`, for one that is cut off, and as cloud_of().
[[nodiscard]] SeenCloud cloud_of_foxglove(std::span<const std::byte> message, bool is_cdr,
                                          TimeUnit& unit, const std::string& what);
[[nodiscard]] SeenCloud scan_of_foxglove(std::span<const std::byte> message, bool is_cdr,
                                         const std::string& what);
// UsageError, which begins with `what`, for one that is cut off.
[[nodiscard]] std::string frame_of_foxglove(std::span<const std::byte> message, bool is_cdr,
                                            const std::string& what);

}  // namespace iog::tools
