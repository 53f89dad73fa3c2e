#include "tools/record/mcap_recording.hpp"

#include <algorithm>

#include "protection/protected_message.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

// Of the reference description, for vehicles that are not known here.
constexpr double kDefaultEpsilon = vehicle::Description{}.epsilon;

constexpr std::uint64_t ns_of(std::uint64_t time_us) { return time_us * 1000; }

// When the frame of a message closed, by the target's clock; otherwise, for what is no message of
// ours, the time at which it came.
std::uint64_t sent_us(const CapturedDatagram& datagram) {
  stream::Header header;
  std::span<const std::byte> body;
  const std::span bytes(datagram.payload);
  const bool is_message = bytes.size() > protection::kProtectionBytes &&
                          stream::read_header(bytes.subspan(protection::kProtectionBytes), header,
                                              body) == stream::ReadStatus::kOk;
  return is_message ? header.closed_us : datagram.time_us;
}

}  // namespace

McapRecording::McapRecording(const std::string& path, const std::vector<std::string>& topics,
                             mcap::Compression compression)
    : file_(path, "ros2", compression) {
  const auto is_wanted = [&](std::string_view topic) {
    return std::ranges::find(topics, topic) != topics.end();
  };
  if (is_wanted(kOccupancyTopic)) {
    add_topic(kOccupancyTopic, ros::kOccupancyGrid);
  }
  if (is_wanted(kImageTopic)) {
    add_topic(kImageTopic, ros::kImage);
  }
  if (is_wanted(kCellsTopic)) {
    add_topic(kCellsTopic, ros::kFoxgloveGrid);
  }
  if (is_wanted(kMessagesTopic)) {
    add_topic(kMessagesTopic, ros::kUint8MultiArray);
  }
}

// All in one encoding, cdr: `ros2 bag play` refuses files with several.
void McapRecording::add_topic(std::string_view topic, const ros::MessageType& type) {
  const std::uint16_t schema = file_.add_schema({.name = std::string(type.name),
                                                 .encoding = "ros2msg",
                                                 .text = std::string(type.definition)});
  channels_[topic] = file_.add_channel({.schema_id = schema,
                                        .topic = std::string(topic),
                                        .message_encoding = "cdr",
                                        .metadata = {{"offered_qos_profiles", ""}}});
}

void McapRecording::take_datagram(const CapturedDatagram& datagram) {
  if (const auto channel = channels_.find(kMessagesTopic); channel != channels_.end()) {
    file_.write(channel->second,
                {.log_ns = ns_of(datagram.time_us), .publish_ns = ns_of(sent_us(datagram))},
                ros::uint8_multi_array(datagram.payload));
  }
}

void McapRecording::take_frame(const RecordedFrame& recorded) {
  const stream::Header& header = recorded.frame->header;
  const ros::Percents& percents = percents_of(header.vehicle_id);
  const mcap::Writer::Times times{.log_ns = ns_of(recorded.time_us),
                                  .publish_ns = ns_of(header.closed_us)};
  if (const auto channel = channels_.find(kOccupancyTopic); channel != channels_.end()) {
    file_.write(channel->second, times, ros::occupancy_grid(*recorded.frame, percents));
  }
  if (const auto channel = channels_.find(kImageTopic); channel != channels_.end()) {
    file_.write(channel->second, times, ros::image(*recorded.frame, percents));
  }
  if (const auto channel = channels_.find(kCellsTopic); channel != channels_.end()) {
    file_.write(channel->second, times, ros::foxglove_grid(*recorded.live, header, percents));
  }
}

void McapRecording::finish(const RunStatistics::Facts& facts) {
  file_.finish(kRunMetadata, {facts.begin(), facts.end()});
}

const ros::Percents& McapRecording::percents_of(std::uint32_t vehicle_id) {
  const CatalogueEntry* const car = vehicle_of_id(vehicle_id);
  const double epsilon = car != nullptr ? car->description->epsilon : kDefaultEpsilon;
  return percents_.try_emplace(epsilon, epsilon).first->second;
}

}  // namespace iog::tools
