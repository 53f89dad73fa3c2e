#include "objects/tracker.hpp"

#include <algorithm>

#include "numeric/magnitude.hpp"
#include "objects/adopt.hpp"
#include "objects/edges.hpp"
#include "objects/judge.hpp"
#include "objects/measure.hpp"
#include "objects/merge.hpp"
#include "objects/motion_shown.hpp"
#include "objects/rules.hpp"

namespace iog::objects {

FrameCounts Tracker::add(const Frame& frame, const GridNames& grid) {
  if (!begin(frame)) {
    return {};
  }
  look_at_hits(0, hits_.all().size(), grid);
  const FrameCounts counts = end(grid);
  remember_hits();
  return counts;
}

bool Tracker::begin(const Frame& frame) {
  counts_ = {};
  if (!pass_to(frame)) {
    return false;
  }
  area_ = frame.area;
  counts_.hits = hits_.gather(frame);
  cut_.begin(frame.ages_ms, step_);
  for (Track& track : used()) {
    if (track.is_there()) {
      track.seen = {};
      track.predict(step_);
      track.look_from(car_);
    }
  }
  counts_.tiles_crowded = claim_.begin(area_, used());
  return true;
}

FrameCounts Tracker::end(const GridNames& grid) {
  claim_.count_contradictions(car_, used(), hits_.all());
  counts_.hits_not_clustered = clusters_.find(area_, car_, hits_);
  attach(car_, used(), clusters_, hits_.all());
  associate(used(), clusters_, hits_.all());
  measure_all();
  counts_.tracks_refused = give_birth();
  merge(used(), hits_.all());
  judge_all(grid);
  leave_free_slots();
  cut_.keep(used(), hits_.all());
  moving_.list(used());
  return counts_;
}

bool Tracker::pass_to(const Frame& frame) {
  if (frame.end_us == now_us_) {
    return false;
  }
  const auto passed_ms = static_cast<std::int64_t>(frame.end_us - now_us_) / 1000;
  const bool goes_on = now_us_ != 0 && passed_ms >= 1 && passed_ms <= kLongestStepMs;
  if (!goes_on) {
    counts_.is_forgotten = now_us_ != 0;
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
  is_told_ = true;
  car_ = frame.car;
  const auto [x, y] = car_velocity_;
  const bool stands = std::max(numeric::magnitude(x), numeric::magnitude(y)) < kCarStandsSpeed;
  blind_mm_ = stands ? frame.blind_mm : 0;
  return true;
}

// end_us may be earlier than the previous one, because the newest pose is older than a slice that
// follows it.
void Tracker::pass(std::uint64_t end_us) {
  constexpr std::uint64_t kLongestUs = std::uint64_t{kLongestStepMs} * 1000;
  constexpr std::uint64_t kLongestToldUs = std::uint64_t{kLongestToldMs} * 1000;
  if (now_us_ == 0 || end_us <= now_us_) {
    return;
  }
  if (end_us - now_us_ > kLongestUs) {
    forget();
  } else if (end_us - now_us_ > kLongestToldUs) {
    is_told_ = false;
    moving_.clear();
  }
}

void Tracker::forget() {
  for (Track& track : used()) {
    track.end();
  }
  leave_free_slots();
  moving_.clear();
  cut_.forget();
  recent_.forget();
  now_us_ = 0;
  car_velocity_ = {};
}

void Tracker::look_at_hits(std::size_t first, std::size_t count, const GridNames& grid) {
  for (FrameHit& hit : hits_.all().subspan(first, count)) {
    const CellName its = grid.look_at(hit.cell);
    hit.name = its.name;
    hit.is_open = its.is_open;
    hit.stands = hit.name == Name::kStanding ||
                 (hit.name != Name::kMoving && grid.names_around(hit.cell).has<Name::kStanding>());
    hit.oldest_epoch = static_cast<std::uint8_t>(recent_.oldest(hit.cell));
    hit.is_old = hit.stands || (hit.name != Name::kMoving && hit.oldest_epoch >= kOldEpochs);
    claim_.take(car_, used(), hit);
  }
}

void Tracker::group_by_owner() {
  owned_.group(hits_.all(), [](const FrameHit& hit) { return hit.owner; });
}

void Tracker::measure_all() {
  group_by_owner();
  for (std::size_t slot = 0; slot < used_; ++slot) {
    if (tracks_[slot].is_there()) {
      const View view = cut_.join(slot, car_, view_of(slot), tracks_[slot]);
      measure(car_, now_us_, step_, view.numbers, view.hits, tracks_[slot]);
      cut_.give_back(slot, view_of(slot));
    }
  }
}

// The lowest free slot; null if there is none.
Track* Tracker::free_slot() {
  const auto found = std::ranges::find(used(), State::kNone, &Track::state);
  if (found != used().end()) {
    return &*found;
  }
  return used_ < tracks_.size() ? &tracks_[used_++] : nullptr;
}

void Tracker::leave_free_slots() {
  while (used_ > 0 && !tracks_[used_ - 1].is_there()) {
    --used_;
  }
}

// Starts a track for each unclaimed cluster. The nearest clusters have the lowest numbers.
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
    Track* const track = free_slot();
    if (track == nullptr) {
      ++refused;
      continue;
    }
    Box box{.at = bounds.middle()};
    box.sides = sides_of(edges_of(box, clusters_.hits_of(i), hits_.all()));
    track->begin(next_id_++, box, now_us_);
    own(*track, static_cast<std::size_t>(track - tracks_.data()), i, clusters_, hits_.all());
    for (const std::uint16_t number : clusters_.hits_of(i)) {
      ++track->seen.hits;
      track->seen.moving += hits_.all()[number].name == Name::kMoving ? 1 : 0;
    }
  }
  return refused;
}

void Tracker::judge_all(const GridNames& grid) {
  group_by_owner();
  for (std::size_t slot = 0; slot < used_; ++slot) {
    Track& track = tracks_[slot];
    if (track.is_there() && is_judged(now_us_, step_, track)) {
      track.look_from(car_);
      const View view = cut_.view_of(slot, view_of(slot));
      weigh_motion(now_us_, {car_, car_velocity_, blind_mm_}, view.numbers,
                   {hits_, recent_, view.hits}, grid, track);
      remember(now_us_, view.numbers, view.hits, track);
      judge(now_us_, track);
    }
  }
}

}  // namespace iog::objects
