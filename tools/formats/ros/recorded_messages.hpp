// The messages of ROS 2 in a recording: MCAP, or rosbag2's sqlite3; a file, or a bag's folder.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace iog::tools::ros {

struct RecordedMessage {
  std::string_view topic;
  std::string_view type;            // "sensor_msgs/msg/LaserScan"
  std::span<const std::byte> data;  // CDR; of Foxglove's own types Protocol Buffers
  std::string where;                // "drive.mcap: message 3 of /scan", for errors
};

// Calls take(message) with each message of one of these types, in the order of the file; of a
// topic, if one is given. Returns remarks: what is not there, and if there is no such message,
// which topics of which types are. UsageError if a file cannot be read or parts of it are damaged,
// or such a message is encoded otherwise.
std::vector<std::string> for_each_message(const std::string& path,
                                          std::span<const std::string_view> types,
                                          std::string_view topic,
                                          const std::function<void(const RecordedMessage&)>& take);

// The file that was unpacked last stays in the folder for temporary files until another one is
// unpacked, so that a bag that is read twice is unpacked once. This removes it.
void forget_unpacked();

}  // namespace iog::tools::ros
