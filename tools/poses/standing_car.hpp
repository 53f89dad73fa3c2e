// The poses of a car that stood still while its sensors were recorded.
#pragma once

#include <cstdint>
#include <string>

namespace iog::tools {

// Writes the datagrams of a capture, and with them a pose of the same place 20 times a second, by
// the capture's clock. Returns how many poses. UsageError as of PcapReader and PcapWriter, if the
// capture has datagrams of that port already, or none at all.
std::uint64_t write_with_standing_poses(const std::string& capture, std::uint16_t pose_port,
                                        const std::string& out);

}  // namespace iog::tools
