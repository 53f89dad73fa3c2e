// A stream as an MCAP file that ROS 2 and Foxglove open (docs/recordings.md).
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/mcap/writer.hpp"
#include "tools/formats/ros/grid_messages.hpp"
#include "tools/record/recording.hpp"

namespace iog::tools {

// What can be in it.
inline constexpr std::string_view kOccupancyTopic = "/grid";
inline constexpr std::string_view kImageTopic = "/iogrid/image";
inline constexpr std::string_view kCellsTopic = "/iogrid/grid";
inline constexpr std::string_view kMessagesTopic = "/iogrid/messages";
inline constexpr std::string_view kRunMetadata = "iogrid";

class McapRecording : public Recording {
 public:
  // UsageError if the file cannot be written.
  McapRecording(const std::string& path, const std::vector<std::string>& topics,
                mcap::Compression compression);

  void take_datagram(const CapturedDatagram& datagram) override;
  void take_frame(const RecordedFrame& frame) override;
  void finish(const RunStatistics::Facts& facts) override;

 private:
  void add_topic(std::string_view topic, const ros::MessageType& type);
  [[nodiscard]] const ros::Percents& percents_of(std::uint32_t vehicle_id);

  mcap::Writer file_;
  std::map<std::string_view, std::uint16_t> channels_;  // by topic
  std::map<double, ros::Percents> percents_;            // by epsilon
};

}  // namespace iog::tools
