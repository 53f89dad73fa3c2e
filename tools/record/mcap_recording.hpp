// A stream as an MCAP file that ROS 2 and Foxglove open (docs/recordings.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/mcap/writer.hpp"
#include "tools/formats/ros/grid_messages.hpp"
#include "tools/record/recording.hpp"

namespace iog::tools {

// What can be in it. A topic that the stream has nothing for is not in the file.
inline constexpr std::string_view kOccupancyTopic = "/grid";
inline constexpr std::string_view kImageTopic = "/iogrid/image";
inline constexpr std::string_view kCellsTopic = "/iogrid/grid";
inline constexpr std::string_view kClassOccupancyTopic = "/classes";
inline constexpr std::string_view kClassesTopic = "/iogrid/classes";
inline constexpr std::string_view kObjectsTopic = "/objects";
inline constexpr std::string_view kTransformTopic = "/tf";
inline constexpr std::string_view kMessagesTopic = "/iogrid/messages";
inline constexpr std::array kAllTopics{kOccupancyTopic,      kImageTopic,   kCellsTopic,
                                       kClassOccupancyTopic, kClassesTopic, kObjectsTopic,
                                       kTransformTopic,      kMessagesTopic};
inline constexpr std::string_view kRunMetadata = "iogrid";

// Which clock header.stamp and the publish time are of: the target's, which begins when it starts,
// or the recorder's, at which the frame had arrived.
enum class Stamp : std::uint8_t { kTarget, kArrival };

class McapRecording : public Recording {
 public:
  // UsageError if the file cannot be written.
  McapRecording(const std::string& path, const std::vector<std::string>& topics,
                mcap::Compression compression, Stamp stamp = Stamp::kTarget);

  void take_datagram(const CapturedDatagram& datagram) override;
  void take_frame(const RecordedFrame& frame) override;
  void finish(const RunStatistics::Facts& facts) override;

 private:
  using Message = std::function<std::vector<std::byte>()>;

  // If the topic is wanted.
  void write(std::string_view topic, const ros::MessageType& type, const mcap::Writer::Times& times,
             const Message& message);
  [[nodiscard]] std::uint16_t channel_of(std::string_view topic, const ros::MessageType& type);
  void take_indexes(const RecordedFrame& recorded, std::uint64_t stamp_us);
  void take_classes(const RecordedFrame& recorded, std::uint64_t stamp_us);
  void take_objects(const RecordedFrame& recorded, std::uint64_t stamp_us);
  [[nodiscard]] const ros::Percents& percents_of(std::uint32_t vehicle_id);

  mcap::Writer file_;
  Stamp stamp_;
  std::set<std::string, std::less<>> topics_;           // that are wanted
  std::map<std::string_view, std::uint16_t> schemas_;   // by their types' names
  std::map<std::string_view, std::uint16_t> channels_;  // by topic
  std::map<double, ros::Percents> percents_;            // by epsilon
  std::vector<std::uint32_t> object_ids_;               // of the last list, in their order
};

}  // namespace iog::tools
