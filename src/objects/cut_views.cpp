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
}

View CutViews::join(std::size_t slot, Point car, View now, Track& track) {
  if (goes_on(slot, now, track)) {
    const Kept& last = kept_[1 - now_];
    const std::int32_t contradicted = track.seen.contradicted;
    track = last.tracks[last.of_slot[slot]];
    track.seen = {.contradicted = contradicted};
    track.predict(step_);
    track.look_from(car);
    joined_of_[slot].first = joined_count_;
    for (const std::uint16_t number : now.numbers) {
      add(slot, track, now.hits[number], 0);
    }
    for (const std::uint16_t number : carried_of_.of(slot)) {
      add(slot, track, carried_[number], step_.ms());
    }
    joined_of_[slot].count = joined_count_ - joined_of_[slot].first;
  } else if (newest_ms_ != oldest_ms_ && has_hit_of(now, newest_ms_)) {
    keep_track(slot, track);
  }
  return view_of(slot, now);
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

void CutViews::keep_track(std::size_t slot, const Track& track) {
  Kept& kept = kept_[now_];
  if (kept.count < kept.tracks.size()) {
    kept.of_slot[slot] = static_cast<std::uint8_t>(kept.count);
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
  for (std::size_t i = 0; joined_of_[slot].count > 0 && i < now.numbers.size(); ++i) {
    const FrameHit& its = joined_[joined_of_[slot].first + i];
    now.hits[now.numbers[i]].owner = its.owner;
    now.hits[now.numbers[i]].moved = its.moved;
  }
}

void CutViews::keep(std::span<const FrameHit> hits) {
  carried_count_ = 0;
  for (const FrameHit& hit : hits) {
    if (hit.owner != kNobody && carried_count_ < carried_.size() &&
        kept_[now_].of_slot[static_cast<std::size_t>(hit.owner)] != kNone) {
      carried_[carried_count_++] = hit;
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
