#include "tools/record/mcap_recording.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "protection/protected_message.hpp"
#include "tools/formats/ros/class_messages.hpp"
#include "tools/formats/ros/object_messages.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

// Of the reference description, for vehicles that are not known here.
constexpr double kDefaultEpsilon = description::Description{}.epsilon;

// How long an object is seen that no frame names again.
constexpr std::uint64_t kFramesOfObjects = 2;

constexpr std::uint64_t ns_of(std::uint64_t time_us) { return time_us * 1000; }

mcap::Writer::Times times_of(const RecordedFrame& recorded, std::uint64_t stamp_us) {
  return {.log_ns = ns_of(recorded.time_us), .publish_ns = ns_of(stamp_us)};
}

// Of the frames of a vehicle, or of the reference description if it is not known here.
std::uint64_t period_us(std::uint32_t vehicle_id) {
  const CatalogueEntry* const car = vehicle_of_id(vehicle_id);
  return (car != nullptr ? *car->description : description::Description{}).frame_period_us;
}

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
                             mcap::Compression compression, Stamp stamp)
    : file_(path, "ros2", compression), stamp_(stamp), topics_(topics.begin(), topics.end()) {}

// All in one encoding, cdr: `ros2 bag play` refuses files with several.
std::uint16_t McapRecording::channel_of(std::string_view topic, const ros::MessageType& type) {
  if (const auto channel = channels_.find(topic); channel != channels_.end()) {
    return channel->second;
  }
  auto schema = schemas_.find(type.name);
  if (schema == schemas_.end()) {
    const std::uint16_t id = file_.add_schema({.name = std::string(type.name),
                                               .encoding = "ros2msg",
                                               .text = std::string(type.definition)});
    schema = schemas_.emplace(type.name, id).first;
  }
  return channels_[topic] = file_.add_channel({.schema_id = schema->second,
                                               .topic = std::string(topic),
                                               .message_encoding = "cdr",
                                               .metadata = {{"offered_qos_profiles", ""}}});
}

void McapRecording::write(std::string_view topic, const ros::MessageType& type,
                          const mcap::Writer::Times& times, const Message& message) {
  if (topics_.contains(topic)) {
    file_.write(channel_of(topic, type), times, message());
  }
}

void McapRecording::take_datagram(const CapturedDatagram& datagram) {
  const std::uint64_t stamp_us = stamp_ == Stamp::kArrival ? datagram.time_us : sent_us(datagram);
  write(kMessagesTopic, ros::kUint8MultiArray,
        {.log_ns = ns_of(datagram.time_us), .publish_ns = ns_of(stamp_us)},
        [&] { return ros::uint8_multi_array(datagram.payload); });
}

void McapRecording::take_frame(const RecordedFrame& recorded) {
  const std::uint64_t stamp_us =
      stamp_ == Stamp::kArrival ? recorded.time_us : recorded.frame->header.closed_us;
  if (recorded.frame->header.has_indexes()) {
    take_indexes(recorded, stamp_us);
  }
  if (recorded.frame->classes && recorded.frame->classes->has_window()) {
    take_classes(recorded, stamp_us);
  }
  if (recorded.frame->knows_objects()) {
    take_objects(recorded, stamp_us);
  }
}

void McapRecording::take_indexes(const RecordedFrame& recorded, std::uint64_t stamp_us) {
  const mcap::Writer::Times times = times_of(recorded, stamp_us);
  const GridFrame& frame = *recorded.frame;
  const ros::Percents& percents = percents_of(frame.header.vehicle_id);
  write(kOccupancyTopic, ros::kOccupancyGrid, times,
        [&] { return ros::occupancy_grid(frame, stamp_us, percents); });
  write(kImageTopic, ros::kImage, times, [&] { return ros::image(frame, stamp_us, percents); });
  write(kCellsTopic, ros::kFoxgloveGrid, times,
        [&] { return ros::foxglove_grid(*recorded.live, stamp_us, percents); });
}

// The pose comes first: what places the grids must be there when they come.
void McapRecording::take_classes(const RecordedFrame& recorded, std::uint64_t stamp_us) {
  const mcap::Writer::Times times = times_of(recorded, stamp_us);
  const ClassGrid& classes = *recorded.frame->classes;
  if (classes.window.has_place()) {
    write(kTransformTopic, ros::kTfMessage, times,
          [&] { return ros::transform_of(classes.window.pose, stamp_us); });
  }
  write(kClassOccupancyTopic, ros::kOccupancyGrid, times,
        [&] { return ros::class_occupancy_grid(classes, stamp_us); });
  write(kClassesTopic, ros::kFoxgloveGrid, times,
        [&] { return ros::foxglove_class_grid(*recorded.classes, stamp_us); });
}

// Who plays frame by frame has what is gone taken away; who plays in time has it end by itself,
// also where no list comes.
void McapRecording::take_objects(const RecordedFrame& recorded, std::uint64_t stamp_us) {
  const GridFrame& frame = *recorded.frame;
  std::vector<std::uint32_t> ids;
  std::ranges::transform(frame.objects->all(), std::back_inserter(ids), &stream::ObjectRecord::id);
  std::vector<std::uint32_t> gone;
  std::ranges::set_difference(object_ids_, ids, std::back_inserter(gone));
  write(kObjectsTopic, ros::kSceneUpdate, times_of(recorded, stamp_us), [&] {
    return ros::scene_update({.stamp_us = stamp_us,
                              .lifetime_us = kFramesOfObjects * period_us(frame.header.vehicle_id),
                              .objects = frame.objects->all(),
                              .gone = gone});
  });
  object_ids_ = std::move(ids);
}

void McapRecording::finish(const RunStatistics::Facts& facts) {
  std::map<std::string, std::string> known(facts.begin(), facts.end());
  known["stamps"] = stamp_ == Stamp::kArrival ? "arrival" : "target";
  file_.finish(kRunMetadata, known);
}

const ros::Percents& McapRecording::percents_of(std::uint32_t vehicle_id) {
  const CatalogueEntry* const car = vehicle_of_id(vehicle_id);
  const double epsilon = car != nullptr ? car->description->epsilon : kDefaultEpsilon;
  return percents_.try_emplace(epsilon, epsilon).first->second;
}

}  // namespace iog::tools
