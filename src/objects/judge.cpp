#include "objects/judge.hpp"

#include <algorithm>

#include "objects/motion_shown.hpp"

namespace iog::objects {
namespace {

bool is_fast(const Track& track) {
  return track.speed() >= kMoveSpeed && track.speed() > kMoveDeviations * track.speed_deviation();
}

// The grid classifies enough of its hits as moving.
bool is_told(const Track& track) {
  const Seen& seen = track.seen;
  return seen.moving >= kToldHits && seen.moving * 100 >= kToldPercent * seen.hits &&
         seen.good >= seen.bad && track.speed() >= std::max(kToldSpeed, track.speed_deviation());
}

// It has long been like a car, and almost no evidence is against it. A car that stays ahead of ours
// at a long distance leaves mostly places that are unknown to the grid. Rails and walls do not look
// that short for that long.
bool is_steady(const Track& track) {
  return track.updates >= kSteadyFrom && track.is_like_a_car() && track.seen.good >= kSteadyHits &&
         track.seen.good >= kGoodOverBad * track.seen.bad;
}

// It is fast; or beams pass many places that it has left, and none of them is hit again.
bool is_clear(const Track& track) {
  const Seen& seen = track.seen;
  const bool has_left = seen.passed >= kClearHits && seen.kept == 0;
  return (has_left || track.speed() >= kClearSpeed) && seen.good >= kClearHits &&
         seen.good >= kGoodOverBad * seen.bad;
}

std::int32_t confidence_of(const Track& track) {
  const bool is_streak = track.is_streak();
  const bool told = !is_streak && is_told(track);
  const bool fast = !is_streak && is_fast(track);
  std::int32_t more = told ? 2 : 0;
  if (fast && (is_shown(track.seen) || is_steady(track)) && track.updates >= kMovesFrom) {
    more += is_clear(track) ? 3 : 2;
  } else if (!told && (!fast || track.seen.bad > track.seen.good)) {
    --more;
  }
  more -= is_streak ? 1 : 0;
  more -= track.seen.bad >= kBadOverGood * std::max<std::int32_t>(track.seen.good, 1) ? 3 : 0;
  return std::clamp<std::int32_t>(track.confidence + more, 0, kMostConfidence);
}

std::int32_t unopposed_of(const Track& track) {
  const Seen& seen = track.seen;
  const bool is_opposed = seen.good + seen.neutral < kGoodOverBad * seen.bad;
  const bool is_supported = !is_opposed && seen.good >= kSteadyHits;
  const std::int32_t more = is_opposed ? -kOpposed : is_supported ? 1 : 0;
  return std::clamp<std::int32_t>(track.unopposed + more, 0, kMostUnopposed);
}

void stop(std::uint64_t since_us, Track& track) {
  track.state = State::kStopped;
  track.stopped_us = since_us;
  track.confidence = 0;
  track.parked_ms = 0;
  track.slow_us = 0;
  track.trail = 0;
  track.rest();
}

// Since when it has hardly moved; 0 if it has. Ignores the estimated speed: for a stationary
// object, that often comes from hits that appear and disappear.
std::uint64_t stays_since_us(std::uint64_t now_us, const Track& track) {
  constexpr std::uint64_t kStayUs = std::uint64_t{kStayMs} * 1000;
  const Snapshot* const then =
      now_us < kStayUs ? nullptr : track.snapshots.youngest_before(now_us - kStayUs);
  if (then == nullptr) {
    return 0;
  }
  const std::int64_t way_mm = range_mm(then->box.at, track.box().at);
  const auto passed_us = static_cast<std::int64_t>(now_us - then->time_us);
  return way_mm * static_cast<std::int64_t>(kStayUs) < kStayMm * passed_us ? then->time_us : 0;
}

// A track has stopped if it was slow for a while, if it has hardly moved, or if it loses its
// confidence at a low speed or with a trail. If it loses its confidence at a higher speed and has
// no trail, it never moved.
void judge_moving(std::uint64_t now_us, Track& track) {
  if (const std::uint64_t since_us = stays_since_us(now_us, track); since_us != 0) {
    stop(since_us, track);
    return;
  }
  if (track.speed() >= kStopSpeed) {
    track.slow_us = 0;
  } else if (track.slow_us == 0) {
    track.slow_us = now_us;
  }
  const std::uint64_t since_us = track.slow_us == 0 ? now_us : track.slow_us;
  const bool is_slow = now_us - since_us >= std::uint64_t{kStopMs} * 1000;
  if (is_slow || (track.confidence == 0 && (track.speed() < kMoveSpeed || track.has_trail()))) {
    stop(since_us, track);
  } else if (track.confidence == 0) {
    track.state = State::kStands;
  }
}

// A moving track has parked if most hits in its box are standing, unless it leaves a trail.
void judge_parked(std::uint64_t now_us, Step step, Track& track) {
  const Seen& seen = track.seen;
  const bool is_parked = !track.has_trail() && seen.standing >= kParkedHits &&
                         seen.standing >= kParkedOverOthers * seen.hits &&
                         track.speed() < kParkedSpeed;
  track.parked_ms =
      std::max<std::int32_t>(track.parked_ms + (is_parked ? step.ms() : -step.ms()), 0);
  if (track.parked_ms >= kStopMs) {
    stop(now_us, track);
  }
}

// Whether it is longer than any object, or moves and is too wide. That happens when an object
// passes another one and is taken for a part of it.
bool is_no_thing(const Track& track) {
  const bool is_wide = track.moves() && track.has_heading() &&
                       track.box().sides[kAcross].length() > kNoThingAcrossMm;
  return is_wide || longest_of(track.box().sides) > kNoThingMm;
}

}  // namespace

bool is_judged(std::uint64_t now_us, Step step, Track& track) {
  if (track.moves()) {
    judge_parked(now_us, step, track);
  }
  if (track.seen.hits == 0) {
    if (now_us - track.seen_us > (track.has_moved() ? kUnseenUs : kUnseenYoungUs)) {
      track.end();
    }
    return false;
  }
  if (is_no_thing(track)) {
    track.end();
  }
  return track.is_there();
}

void judge(std::uint64_t now_us, Track& track) {
  track.confidence = confidence_of(track);
  track.unopposed = unopposed_of(track);
  if (!track.moves() && track.confidence >= kMovingConfidence && track.updates >= kMovesFrom &&
      track.speed() >= kStopSpeed) {
    track.state = State::kMoves;
    track.slow_us = 0;
  }
  if (track.moves()) {
    judge_moving(now_us, track);
  } else if (track.state == State::kYoung && track.updates >= kSettledFrom && !is_fast(track)) {
    track.state = State::kStands;
  }
}

}  // namespace iog::objects
