// A stream as an MCAP file that ROS 2 and Foxglove open (docs/recordings.md).
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/mcap/writer.hpp"
#include "tools/record/recording.hpp"
#include "tools/record/topic_messages.hpp"

namespace iog::tools {

inline constexpr std::string_view kRunMetadata = "iogrid";

class McapRecording : public Recording, private TopicSink {
 public:
  // UsageError if the file cannot be written.
  McapRecording(const std::string& path, const std::vector<std::string>& topics,
                mcap::Compression compression, Stamp stamp = Stamp::kTarget);

  [[nodiscard]] bool wants_points() const override { return topics_.contains(kPointsTopic); }
  void keep_beginning() override { file_.keep_beginning(); }
  void take_datagram(const CapturedDatagram& datagram) override;
  void take_frame(const RecordedFrame& frame) override;
  void finish(const Facts& facts) override;

 private:
  [[nodiscard]] bool wants(std::string_view topic, const ros::MessageType& type) override;
  void take(std::string_view topic, const ros::MessageType& type, const MessageTimes& times,
            std::vector<std::byte> message) override;
  [[nodiscard]] std::uint16_t channel_of(std::string_view topic, const ros::MessageType& type);

  mcap::Writer file_;
  Stamp stamp_;
  TopicMessages messages_;
  std::set<std::string, std::less<>> topics_;           // that are wanted
  std::map<std::string_view, std::uint16_t> schemas_;   // by their types' names
  std::map<std::string_view, std::uint16_t> channels_;  // by topic
};

}  // namespace iog::tools
