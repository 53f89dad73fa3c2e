// A lidar's own packets in a recording of ROS 2, as drivers keep them before they make clouds:
// velodyne_msgs/VelodyneScan, nebula_msgs/NebulaPackets, pandar_msgs/PandarScan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace iog::tools::ros {

// Calls take(time_us, payload) with each packet of a topic; of none, if the only one with packets
// is meant. Returns remarks: what is not there. UsageError as for_each_message(), if there is no
// packet or a message is cut off, or if several topics have packets and none is chosen.
std::vector<std::string> for_each_packet(
    const std::string& path, std::string_view topic,
    const std::function<void(std::uint64_t, std::span<const std::byte>)>& take);

}  // namespace iog::tools::ros
