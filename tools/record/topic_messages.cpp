#include "tools/record/topic_messages.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "protection/protected_message.hpp"
#include "tools/formats/ros/class_messages.hpp"
#include "tools/formats/ros/diagnostic_messages.hpp"
#include "tools/formats/ros/mount_messages.hpp"
#include "tools/formats/ros/object_messages.hpp"
#include "tools/formats/ros/point_messages.hpp"
#include "tools/record/frame_diagnostics.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

// How long an object is seen that no frame names again.
constexpr std::uint64_t kFramesOfObjects = 2;

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

void TopicMessages::write(std::string_view topic, const ros::MessageType& type,
                          const MessageTimes& times, const Message& message) {
  if (sink_->wants(topic, type)) {
    sink_->take(topic, type, times, message());
  }
}

void TopicMessages::take_datagram(const CapturedDatagram& datagram) {
  const std::uint64_t stamp_us = stamp_ == Stamp::kTarget ? sent_us(datagram) : datagram.time_us;
  write(kMessagesTopic, ros::kUint8MultiArray,
        {.arrival_us = datagram.time_us, .stamp_us = stamp_us},
        [&] { return ros::uint8_multi_array(datagram.payload); });
}

void TopicMessages::take_frame(const RecordedFrame& recorded) {
  const GridFrame& frame = *recorded.frame;
  const std::optional<std::uint64_t> stamp_us = stamp_of(recorded);
  if (!stamp_us) {
    return;
  }
  const MessageTimes times{.arrival_us = recorded.time_us, .stamp_us = *stamp_us};
  take_diagnostics(recorded, times);
  take_mounts(recorded, times);
  if (frame.header.has_indexes()) {
    take_indexes(recorded, times);
  }
  if (frame.classes && frame.classes->has_window()) {
    take_classes(recorded, times);
  }
  if (frame.knows_objects()) {
    take_objects(recorded, times);
  }
  if (!recorded.points.empty()) {
    write(kPointsTopic, ros::kPointCloud, times,
          [&] { return ros::point_cloud(recorded.points, times.stamp_us); });
  }
}

std::optional<std::uint64_t> TopicMessages::stamp_of(const RecordedFrame& recorded) const {
  const GridFrame& frame = *recorded.frame;
  switch (stamp_) {
    case Stamp::kTarget:
      return frame.header.closed_us;
    case Stamp::kArrival:
      return recorded.time_us;
    case Stamp::kPoses:
      break;
  }
  const bool has_window = frame.classes && frame.classes->has_window();
  return has_window ? std::optional(frame.classes->window.slices_end_us) : std::nullopt;
}

void TopicMessages::take_diagnostics(const RecordedFrame& recorded, const MessageTimes& times) {
  write(kDiagnosticsTopic, ros::kDiagnosticArray, times, [&] {
    return ros::diagnostic_array(diagnostics_of(*recorded.frame),
                                 words_of_vehicle(recorded.frame->header.vehicle_id),
                                 times.stamp_us);
  });
}

// In every frame, so that who comes late or begins in the middle has them.
void TopicMessages::take_mounts(const RecordedFrame& recorded, const MessageTimes& times) {
  if (const CatalogueEntry* const car = vehicle_of_id(recorded.frame->header.vehicle_id)) {
    write(kMountsTopic, ros::kTfMessage, times,
          [&] { return ros::mounts_of(car->sensors, times.stamp_us); });
  }
}

void TopicMessages::take_indexes(const RecordedFrame& recorded, const MessageTimes& times) {
  const GridFrame& frame = *recorded.frame;
  const ros::Percents& percents = percents_of(frame.epsilon());
  write(kOccupancyTopic, ros::kOccupancyGrid, times,
        [&] { return ros::occupancy_grid(frame, times.stamp_us, percents); });
  write(kImageTopic, ros::kImage, times,
        [&] { return ros::image(frame, times.stamp_us, percents); });
  write(kCellsTopic, ros::kFoxgloveGrid, times,
        [&] { return ros::foxglove_grid(*recorded.live, times.stamp_us, percents); });
}

// The pose comes first: what places the grids must be there when they come.
void TopicMessages::take_classes(const RecordedFrame& recorded, const MessageTimes& times) {
  const ClassGrid& classes = *recorded.frame->classes;
  if (classes.window.has_place()) {
    write(kTransformTopic, ros::kTfMessage, times,
          [&] { return ros::transform_of(classes.window.pose, times.stamp_us); });
  }
  write(kClassOccupancyTopic, ros::kOccupancyGrid, times,
        [&] { return ros::class_occupancy_grid(classes, times.stamp_us); });
  write(kClassesTopic, ros::kFoxgloveGrid, times,
        [&] { return ros::foxglove_class_grid(*recorded.classes, times.stamp_us); });
}

// Who plays frame by frame has what is gone taken away; who plays in time has it end by itself,
// also where no list comes.
void TopicMessages::take_objects(const RecordedFrame& recorded, const MessageTimes& times) {
  const GridFrame& frame = *recorded.frame;
  const std::uint64_t lifetime_us = kFramesOfObjects * period_us(frame.header.vehicle_id);
  write(kMarkersTopic, ros::kMarkerArray, times, [&] {
    return ros::marker_array({.stamp_us = times.stamp_us,
                              .lifetime_us = lifetime_us,
                              .objects = frame.objects->all(),
                              .gone = {}});
  });
  write(kObjectsTopic, ros::kSceneUpdate, times, [&] {
    std::vector<std::uint32_t> ids;
    std::ranges::transform(frame.objects->all(), std::back_inserter(ids),
                           &stream::ObjectRecord::id);
    std::vector<std::uint32_t> gone;
    std::ranges::set_difference(object_ids_, ids, std::back_inserter(gone));
    object_ids_ = std::move(ids);
    return ros::scene_update({.stamp_us = times.stamp_us,
                              .lifetime_us = lifetime_us,
                              .objects = frame.objects->all(),
                              .gone = gone});
  });
}

const ros::Percents& TopicMessages::percents_of(std::optional<double> epsilon) {
  return percents_.try_emplace(epsilon, epsilon).first->second;
}

}  // namespace iog::tools
