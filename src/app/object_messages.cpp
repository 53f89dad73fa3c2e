// Ranges: speeds are within 10^5 mm/s, 10^4 cm/s. Deviations are below 2^16 mm and mm/s, since
// variances are below 2^31.
#include "app/object_messages.hpp"

#include <algorithm>

#include "numeric/arctangent.hpp"
#include "numeric/division.hpp"
#include "numeric/heap_sort.hpp"
#include "numeric/square_root.hpp"
#include "objects/stated.hpp"

namespace iog::app {
namespace {

using objects::kAcross;
using objects::kAlong;

constexpr std::uint16_t at_most(std::uint64_t value, std::uint16_t most) {
  return static_cast<std::uint16_t>(std::min<std::uint64_t>(value, most));
}
constexpr std::uint16_t or_more(std::uint64_t value) { return at_most(value, stream::kAtLeast); }

constexpr stream::ObjectState state_of(objects::State state) {
  switch (state) {
    case objects::State::kStands:
      return stream::ObjectState::kStands;
    case objects::State::kMoves:
      return stream::ObjectState::kMoves;
    case objects::State::kStopped:
      return stream::ObjectState::kStopped;
    case objects::State::kYoung:
    case objects::State::kNone:
      break;
  }
  return stream::ObjectState::kYoung;
}

objects::Point middle_of(const objects::Box& box) {
  const objects::Point a = box.corner(0);
  const objects::Point b = box.corner(3);
  return {a.x_mm + (b.x_mm - a.x_mm) / 2, a.y_mm + (b.y_mm - a.y_mm) / 2};
}

// In tens, rounded to nearest.
std::uint16_t tens_of(std::int32_t value) {
  return or_more(static_cast<std::uint64_t>(numeric::div_nearest<std::int32_t>(value, 10)));
}

// Square root, rounded up.
std::uint32_t root_of(std::int32_t variance) {
  const auto square = static_cast<std::uint64_t>(std::max<std::int32_t>(variance, 0));
  const std::uint32_t root = numeric::square_root(square);
  return root * std::uint64_t{root} < square ? root + 1 : root;
}

// In cm/s.
std::uint16_t speed_deviation_of(const objects::Track& track, objects::Side side,
                                 std::uint64_t now_us, objects::Point car) {
  const std::uint32_t deviation =
      objects::stated_deviation(root_of(track.covariance(side).speed()), track, now_us, car);
  return at_most((deviation + 9) / 10, stream::kNotBelieved - 1);
}

std::uint16_t flags_of(const objects::Track& track, std::uint64_t now_us) {
  const unsigned heading = track.has_heading() ? stream::kObjectHasHeading : 0U;
  const unsigned not_hit = track.seen_us != now_us ? stream::kObjectNotHit : 0U;
  const unsigned end_hidden = track.seen.is_end_hidden ? stream::kObjectEndHidden : 0U;
  return static_cast<std::uint16_t>(heading | not_hit | end_hidden);
}

}  // namespace

stream::ObjectRecord record_of(const objects::Track& track, std::uint64_t now_us,
                               objects::Point car) {
  const objects::Box& box = track.box();
  const objects::Point middle = middle_of(box);
  const objects::Velocity velocity = track.believed_velocity();
  stream::ObjectRecord object{
      .id = track.id,
      .state = state_of(track.state),
      .existence = static_cast<std::uint8_t>(track.confidence * 255 / objects::kMostConfidence),
      .age_frames = or_more(track.updates),
      .x_mm = middle.x_mm,
      .y_mm = middle.y_mm,
      .length_cm = tens_of(box.sides[kAlong].length()),
      .width_cm = tens_of(box.sides[kAcross].length()),
      .flags = flags_of(track, now_us),
      .vx_cm_s = static_cast<std::int16_t>(numeric::div_nearest<std::int32_t>(velocity.x, 10)),
      .vy_cm_s = static_cast<std::int16_t>(numeric::div_nearest<std::int32_t>(velocity.y, 10)),
      .sigma_along_mm = or_more(root_of(track.covariance(kAlong).place())),
      .sigma_across_mm = or_more(root_of(track.covariance(kAcross).place())),
      .since_hit_ms = or_more((now_us - track.seen_us) / 1000)};
  if (track.has_heading()) {
    object.heading = numeric::angle_of(box.along.x, box.along.y);
  }
  if (object.is_believed()) {
    object.sigma_v_along_cm_s = speed_deviation_of(track, kAlong, now_us, car);
    object.sigma_v_across_cm_s = speed_deviation_of(track, kAcross, now_us, car);
  }
  if (object.state == stream::ObjectState::kStopped) {
    object.since_stopped_10ms = or_more((now_us - track.stopped_us) / 10'000);
  }
  return object;
}

void list_objects(const objects::Tracks& tracks, std::uint64_t time_us,
                  const objects::FrameCounts& counts, objects::Point car,
                  stream::ObjectList& list) {
  list.time_us = time_us;
  list.tracks_refused = or_more(counts.tracks_refused);
  list.hits_left = or_more(std::uint64_t{counts.hits.beyond} + counts.hits_not_clustered);
  list.count = 0;
  if (!list.has_place()) {
    return;
  }
  for (const objects::Track& track : tracks) {
    if (track.is_there() && track.updates >= kToldFrom) {
      list.records[list.count++] = record_of(track, list.time_us, car);
    }
  }
  numeric::heap_sort(
      std::span(list.records).first(list.count),
      [](const stream::ObjectRecord& a, const stream::ObjectRecord& b) { return a.id < b.id; });
}
static_assert(objects::kMostTracks <= stream::kMaxObjects);

}  // namespace iog::app
