// A file of rosbag2's storage `sqlite3`: a table of topics, and one of messages. It is only read,
// and one message at a time is in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace iog::tools::ros {

struct BagTopic {
  std::string name;
  std::string type;      // "sensor_msgs/msg/LaserScan"
  std::string encoding;  // "cdr"
  std::uint64_t messages = 0;
  std::uint64_t duration_ns = 0;  // from its first to its last message
};

// With the number of messages of each and their duration. UsageError as below.
[[nodiscard]] std::vector<BagTopic> topics_in_sqlite(const std::string& path,
                                                     const std::string& what);

// Calls take(topic, message) with each message of a topic that wants(topic), in the order of
// recording. Returns how many are of no topic in the file. UsageError, which begins with `what`, if
// the file is not of this kind or is damaged.
std::uint64_t for_each_in_sqlite(
    const std::string& path, const std::string& what,
    const std::function<bool(const BagTopic&)>& wants,
    const std::function<void(const BagTopic&, std::span<const std::byte>)>& take);

}  // namespace iog::tools::ros
