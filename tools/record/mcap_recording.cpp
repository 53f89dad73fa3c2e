#include "tools/record/mcap_recording.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t ns_of(std::uint64_t time_us) { return time_us * 1000; }

}  // namespace

McapRecording::McapRecording(const std::string& path, const std::vector<std::string>& topics,
                             mcap::Compression compression, Stamp stamp)
    : file_(path, "ros2", compression),
      stamp_(stamp),
      messages_(*this, stamp),
      topics_(topics.begin(), topics.end()) {}

void McapRecording::take_datagram(const CapturedDatagram& datagram) {
  messages_.take_datagram(datagram);
}

void McapRecording::take_frame(const RecordedFrame& frame) { messages_.take_frame(frame); }

bool McapRecording::wants(std::string_view topic, const ros::MessageType& /*type*/) {
  return topics_.contains(topic);
}

void McapRecording::take(std::string_view topic, const ros::MessageType& type,
                         const MessageTimes& times, std::vector<std::byte> message) {
  file_.write(channel_of(topic, type),
              {.log_ns = ns_of(times.arrival_us), .publish_ns = ns_of(times.stamp_us)}, message);
}

std::uint16_t McapRecording::channel_of(std::string_view topic, const ros::MessageType& type) {
  if (const auto channel = channels_.find(topic); channel != channels_.end()) {
    return channel->second;
  }
  auto schema = schemas_.find(type.name);
  if (schema == schemas_.end()) {
    const std::uint16_t id = file_.add_schema({.name = std::string(type.name),
                                               .encoding = std::string(kSchemaEncoding),
                                               .text = std::string(type.definition)});
    schema = schemas_.emplace(type.name, id).first;
  }
  return channels_[topic] = file_.add_channel({.schema_id = schema->second,
                                               .topic = std::string(topic),
                                               .message_encoding = std::string(kMessageEncoding),
                                               .metadata = {{"offered_qos_profiles", ""}}});
}

void McapRecording::finish(const Facts& facts) {
  std::map<std::string, std::string> known(facts.begin(), facts.end());
  known["stamps"] = kStampNames.at(static_cast<std::size_t>(stamp_));
  file_.finish(kRunMetadata, known);
}

}  // namespace iog::tools
