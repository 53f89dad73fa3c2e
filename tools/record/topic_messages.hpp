// What other tools take of a stream, message by message and topic by topic (docs/recordings.md),
// whether it goes into a file or to somebody who looks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "tools/formats/ros/grid_messages.hpp"
#include "tools/record/recording.hpp"

namespace iog::tools {

// A topic that the stream has nothing for has no message.
inline constexpr std::string_view kTransformTopic = "/tf";
inline constexpr std::string_view kMountsTopic = "/tf_static";
inline constexpr std::string_view kOccupancyTopic = "/grid";
inline constexpr std::string_view kImageTopic = "/iogrid/image";
inline constexpr std::string_view kCellsTopic = "/iogrid/grid";
inline constexpr std::string_view kClassOccupancyTopic = "/classes";
inline constexpr std::string_view kClassesTopic = "/iogrid/classes";
inline constexpr std::string_view kObjectsTopic = "/objects";
inline constexpr std::string_view kMarkersTopic = "/objects/markers";
inline constexpr std::string_view kPointsTopic = "/points";
inline constexpr std::string_view kDiagnosticsTopic = "/diagnostics";
inline constexpr std::string_view kMessagesTopic = "/iogrid/messages";
inline constexpr std::array kAllTopics{kTransformTopic, kMountsTopic,      kOccupancyTopic,
                                       kImageTopic,     kCellsTopic,       kClassOccupancyTopic,
                                       kClassesTopic,   kObjectsTopic,     kMarkersTopic,
                                       kPointsTopic,    kDiagnosticsTopic, kMessagesTopic};
// Of every message: all in one encoding, as `ros2 bag play` demands of a file.
inline constexpr std::string_view kMessageEncoding = "cdr";
inline constexpr std::string_view kSchemaEncoding = "ros2msg";

// Which clock header.stamp and the publish time are of: the target's, which begins when it starts;
// the recorder's, at which the frame had arrived; or that of the poses, at the end of the frame's
// last slice (docs/spec.md 5.3).
enum class Stamp : std::uint8_t { kTarget, kArrival, kPoses };
inline constexpr std::array<std::string_view, 3> kStampNames{"target", "arrival", "poses"};

struct MessageTimes {
  std::uint64_t arrival_us = 0;  // since 1970
  std::uint64_t stamp_us = 0;    // by the clock of the stamps
};

class TopicSink {
 public:
  TopicSink() = default;
  virtual ~TopicSink() = default;
  TopicSink(const TopicSink&) = delete;
  TopicSink& operator=(const TopicSink&) = delete;

  // There is a message of this topic. It is made only if somebody wants it.
  [[nodiscard]] virtual bool wants(std::string_view topic, const ros::MessageType& type) = 0;
  // The message, serialised, if it was wanted.
  virtual void take(std::string_view topic, const ros::MessageType& type, const MessageTimes& times,
                    std::vector<std::byte> message) = 0;
};

class TopicMessages {
 public:
  // The sink outlives this. With kPoses frames without classes have no message but those of
  // kMessagesTopic, whose stamps are those of arrival.
  TopicMessages(TopicSink& sink, Stamp stamp) : sink_(&sink), stamp_(stamp) {}

  void take_datagram(const CapturedDatagram& datagram);
  void take_frame(const RecordedFrame& frame);

 private:
  using Message = std::function<std::vector<std::byte>()>;

  void write(std::string_view topic, const ros::MessageType& type, const MessageTimes& times,
             const Message& message);
  void take_diagnostics(const RecordedFrame& recorded, const MessageTimes& times);
  void take_mounts(const RecordedFrame& recorded, const MessageTimes& times);
  void take_indexes(const RecordedFrame& recorded, const MessageTimes& times);
  void take_classes(const RecordedFrame& recorded, const MessageTimes& times);
  void take_objects(const RecordedFrame& recorded, const MessageTimes& times);
  [[nodiscard]] std::optional<std::uint64_t> stamp_of(const RecordedFrame& recorded) const;
  [[nodiscard]] const ros::Percents& percents_of(std::optional<double> epsilon);

  TopicSink* sink_;
  Stamp stamp_;
  std::map<std::optional<double>, ros::Percents> percents_;  // by epsilon
  std::vector<std::uint32_t> object_ids_;  // of the last list that was wanted, in their order
};

}  // namespace iog::tools
