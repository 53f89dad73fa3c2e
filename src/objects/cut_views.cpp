#include "objects/cut_views.hpp"

#include <algorithm>

#include "objects/claim.hpp"

namespace iog::objects {
namespace {

bool has_hit_of(const View& view, std::int32_t age_ms) {
  return std::ranges::any_of(
      view.numbers, [&](std::uint16_t number) { return view.hits[number].age_ms == age_ms; });
}

}  // namespace

void CutViews::begin(std::span<const std::uint8_t> ages_ms, Step step) {
  const auto [newest, oldest] = std::ranges::minmax_element(ages_ms);
  newest_ms_ = ages_ms.empty() ? 0 : *newest;
  oldest_ms_ = ages_ms.empty() ? 0 : *oldest;
  step_ = step;
  is_adjacent_ = step.ms() <= oldest_ms_ + kCutGapMs;
  now_ = 1 - now_;
  kept_[now_].count = 0;
  kept_[now_].of_slot.fill(kNone);
  joined_count_ = 0;
  joined_of_.fill({});
  waiting_count_ = 0;
}

View CutViews::join(std::size_t slot, Point car, View now, Track& track) {
  const std::int32_t older_ms = older_sweep_of(now);
  const bool is_on = goes_on(slot, now, track);
  if (is_on && kept_[1 - now_].waits_below(slot) == kAll) {
    undo(slot, car, track);
  }
  if (is_on || older_ms > 0) {
    joined_of_[slot].first = joined_count_;
    for (const std::uint16_t number : now.numbers) {
      if (now.hits[number].age_ms >= older_ms) {
        add(slot, track, now.hits[number], 0);
      }
    }
    waiting_count_ += now.numbers.size() - (joined_count_ - joined_of_[slot].first);
    for (std::size_t i = 0; is_on && i < carried_of_.of(slot).size(); ++i) {
      add(slot, track, carried_[carried_of_.of(slot)[i]], step_.ms());
    }
    joined_of_[slot].count = joined_count_ - joined_of_[slot].first;
  }
  if (older_ms > 0) {
    keep_track(slot, track, older_ms);
  } else if (!is_on && newest_ms_ != oldest_ms_ && has_hit_of(now, newest_ms_)) {
    keep_track(slot, track, kAll);
  }
  return view_of(slot, now);
}

// Restores the track as it was before its part in the last frame.
void CutViews::undo(std::size_t slot, Point car, Track& track) const {
  const Kept& last = kept_[1 - now_];
  const std::int32_t contradicted = track.seen.contradicted;
  track = last.tracks[last.of_slot[slot]];
  track.seen = {.contradicted = contradicted};
  track.predict(step_);
  track.look_from(car);
}

// Returns the least age in the older sweep; 0 if there is one sweep, or no room for two.
std::int32_t CutViews::older_sweep_of(const View& view) const {
  if (kept_[now_].count == kMostCutTracks || joined_count_ + view.numbers.size() > joined_.size() ||
      !has_hit_of(view, newest_ms_) || !has_hit_of(view, oldest_ms_)) {
    return 0;
  }
  std::int32_t newer = newest_ms_;
  std::int32_t older = oldest_ms_;
  std::size_t waiting = waiting_count_;
  for (const std::uint16_t number : view.numbers) {
    const std::int32_t age_ms = view.hits[number].age_ms;
    const bool is_newer = age_ms <= (newest_ms_ + oldest_ms_) / 2;
    newer = is_newer ? std::max(newer, age_ms) : newer;
    older = is_newer ? older : std::min(older, age_ms);
    waiting += is_newer ? 1U : 0U;
  }
  return older - newer > kTurnGapMs && waiting <= carried_.size() ? older : 0;
}

// The oldest slice has a part of it, and so had the newest slice of the last frame.
bool CutViews::goes_on(std::size_t slot, const View& now, const Track& track) const {
  const Kept& last = kept_[1 - now_];
  const std::uint8_t kept = last.of_slot[slot];
  const std::size_t before = carried_of_.of(slot).size();
  return is_adjacent_ && kept != kNone && before > 0 && last.tracks[kept].id == track.id &&
         joined_count_ + now.numbers.size() + before <= joined_.size() &&
         has_hit_of(now, oldest_ms_);
}

void CutViews::keep_track(std::size_t slot, const Track& track, std::int32_t below_ms) {
  Kept& kept = kept_[now_];
  if (kept.count < kept.tracks.size()) {
    kept.of_slot[slot] = static_cast<std::uint8_t>(kept.count);
    kept.below_ms[kept.count] = below_ms;
    kept.tracks[kept.count++] = track;
  }
}

void CutViews::add(std::size_t slot, const Track& track, const FrameHit& hit,
                   std::int32_t more_ms) {
  FrameHit& its = joined_[joined_count_];
  its = hit;
  its.age_ms += more_ms;
  own(track, slot, its);
  numbers_[joined_count_] = static_cast<std::uint16_t>(joined_count_);
  ++joined_count_;
}

View CutViews::view_of(std::size_t slot, View now) {
  const Range its = joined_of_[slot];
  return its.count == 0 ? now : View{std::span(numbers_).subspan(its.first, its.count), joined_};
}

void CutViews::give_back(std::size_t slot, View now) const {
  if (joined_of_[slot].count == 0) {
    return;
  }
  std::size_t next = joined_of_[slot].first;
  for (const std::uint16_t number : now.numbers) {
    if (FrameHit& hit = now.hits[number]; hit.age_ms >= kept_[now_].waits_below(slot)) {
      hit.owner = joined_[next].owner;
      hit.moved = joined_[next].moved;
      ++next;
    }
  }
}

void CutViews::keep(std::span<const Track> tracks, std::span<const FrameHit> hits) {
  Kept& kept = kept_[now_];
  for (std::size_t slot = 0; slot < tracks.size(); ++slot) {
    if (tracks[slot].seen.has_merged && kept.waits_below(slot) == kAll) {
      kept.of_slot[slot] = kNone;
    }
  }
  carried_count_ = 0;
  for (const bool is_waiting : {true, false}) {
    for (const FrameHit& hit : hits) {
      const std::int32_t below_ms =
          hit.owner == kNobody ? 0 : kept.waits_below(static_cast<std::size_t>(hit.owner));
      if ((below_ms < kAll) == is_waiting && hit.age_ms < below_ms &&
          carried_count_ < carried_.size()) {
        carried_[carried_count_++] = hit;
      }
    }
  }
  carried_of_.group(std::span(carried_).first(carried_count_),
                    [](const FrameHit& hit) { return hit.owner; });
}

void CutViews::forget() {
  kept_[now_].of_slot.fill(kNone);
  carried_count_ = 0;
  carried_of_.group({}, [](const FrameHit& hit) { return hit.owner; });
}

}  // namespace iog::objects
