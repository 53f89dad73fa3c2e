#include "objects/tracker.hpp"

#include <algorithm>

#include "objects/adopt.hpp"
#include "objects/edges.hpp"
#include "objects/judge.hpp"
#include "objects/measure.hpp"
#include "objects/merge.hpp"
#include "objects/motion_shown.hpp"

namespace iog::objects {

FrameCounts Tracker::add(const Frame& frame, const GridNames& grid) {
  FrameCounts counts;
  if (!begin(frame, counts)) {
    return counts;
  }
  counts.hits = hits_.gather(frame);
  look_at_hits(grid);
  for (Track& track : tracks_) {
    if (track.is_there()) {
      track.seen = {};
      track.predict(step_);
    }
  }
  counts.tiles_crowded = claim_.take(frame.area, tracks_, hits_.all());
  counts.hits_not_clustered = clusters_.find(frame.area, car_, hits_);
  attach(car_, tracks_, clusters_, hits_.all());
  associate(tracks_, clusters_, hits_.all());
  measure_all();
  counts.tracks_refused = give_birth();
  merge(tracks_, hits_.all());
  judge_all(grid);
  recent_.add(now_us_, hits_.all());
  return counts;
}

bool Tracker::begin(const Frame& frame, FrameCounts& counts) {
  if (frame.end_us == now_us_) {
    return false;
  }
  const auto passed_ms = static_cast<std::int64_t>(frame.end_us - now_us_) / 1000;
  const bool goes_on = now_us_ != 0 && passed_ms >= 1 && passed_ms <= kLongestStepMs;
  if (!goes_on) {
    counts.is_forgotten = now_us_ != 0;
    forget();
  } else {
    step_ = Step(static_cast<std::int32_t>(passed_ms));
    const auto speed = [&](std::int32_t way_mm) {
      return static_cast<std::int32_t>(std::clamp<std::int64_t>(
          std::int64_t{way_mm} * 1000 / passed_ms, -kMostSpeed, kMostSpeed));
    };
    car_velocity_ = {speed(frame.car.x_mm - car_.x_mm), speed(frame.car.y_mm - car_.y_mm)};
  }
  now_us_ = frame.end_us;
  car_ = frame.car;
  return true;
}

// It may end before the one before it, as the newest pose is older than a slice that follows it.
void Tracker::pass(std::uint64_t end_us) {
  constexpr std::uint64_t kLongestUs = std::uint64_t{kLongestStepMs} * 1000;
  if (now_us_ != 0 && end_us > now_us_ && end_us - now_us_ > kLongestUs) {
    forget();
  }
}

void Tracker::forget() {
  for (Track& track : tracks_) {
    track.end();
  }
  recent_.forget();
  now_us_ = 0;
  car_velocity_ = {};
}

void Tracker::look_at_hits(const GridNames& grid) {
  for (FrameHit& hit : hits_.all()) {
    hit.name = grid.name_of(hit.cell);
    hit.is_open = grid.is_open(hit.cell);
    hit.stands = hit.name == Name::kStanding ||
                 (hit.name != Name::kMoving &&
                  grid.is_any_near(hit.cell, [](Name name) { return name == Name::kStanding; }));
    hit.oldest_epoch = static_cast<std::uint8_t>(recent_.oldest(hit.cell));
    hit.is_old = hit.stands || (hit.name != Name::kMoving && hit.oldest_epoch >= kOldEpochs);
  }
}

void Tracker::group_by_owner() {
  owned_.group(hits_.all(), [](const FrameHit& hit) { return hit.owner; });
}

void Tracker::measure_all() {
  group_by_owner();
  for (std::size_t slot = 0; slot < tracks_.size(); ++slot) {
    if (tracks_[slot].is_there()) {
      measure(car_, now_us_, owned_.of(slot), hits_.all(), tracks_[slot]);
    }
  }
}

std::size_t Tracker::free_slot() const {
  const auto found = std::ranges::find(tracks_, State::kNone, &Track::state);
  return static_cast<std::size_t>(found - tracks_.begin());
}

// Of clusters that are nobody's; the nearest have the lowest numbers.
std::uint32_t Tracker::give_birth() {
  std::uint32_t refused = 0;
  const std::span<Cluster> all = clusters_.all();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Bounds& bounds = all[i].bounds;
    if (all[i].owner != kNobody || all[i].hits < kBirthHits ||
        bounds.high.x_mm - bounds.low.x_mm > kLongestMm ||
        bounds.high.y_mm - bounds.low.y_mm > kLongestMm) {
      continue;
    }
    const std::size_t slot = free_slot();
    if (slot == tracks_.size()) {
      ++refused;
      continue;
    }
    Box box{.at = bounds.middle()};
    box.sides = sides_of(edges_of(box, clusters_.hits_of(i), hits_.all()));
    tracks_[slot].begin(next_id_++, box, now_us_);
    own(tracks_[slot], slot, i, clusters_, hits_.all());
    for (const std::uint16_t number : clusters_.hits_of(i)) {
      ++tracks_[slot].seen.hits;
      tracks_[slot].seen.moving += hits_.all()[number].name == Name::kMoving ? 1 : 0;
    }
  }
  return refused;
}

void Tracker::judge_all(const GridNames& grid) {
  group_by_owner();
  for (std::size_t slot = 0; slot < tracks_.size(); ++slot) {
    Track& track = tracks_[slot];
    if (track.is_there() && is_judged(now_us_, step_, track)) {
      weigh_motion(now_us_, car_, car_velocity_, owned_.of(slot), hits_.all(), grid, track);
      remember(now_us_, owned_.of(slot), hits_.all(), track);
      judge(now_us_, track);
    }
  }
}

bool Tracker::is_in_moving_box(geometry::Cell cell) const {
  const Point at = centre_of(cell);
  return std::ranges::any_of(tracks_, [&](const Track& track) {
    return track.moves() && track.box().outside(at) <= kTailMm;
  });
}

}  // namespace iog::objects
