#include "pose/history.hpp"

#include <algorithm>

namespace iog::pose {
namespace {

constexpr Motion motion_of(const Message& message) {
  return {.speed_mm_per_s = message.speed_mm_per_s, .yaw_urad_per_s = message.yaw_urad_per_s};
}

// At most half a unit too low.
constexpr Motion mean_of(const Motion& a, const Motion& b) {
  return {.speed_mm_per_s = (a.speed_mm_per_s + b.speed_mm_per_s) >> 1,
          .yaw_urad_per_s = (a.yaw_urad_per_s + b.yaw_urad_per_s) >> 1};
}

constexpr Sigma larger_of(const Sigma& a, const Sigma& b) {
  return {.position_mm = std::max(a.position_mm, b.position_mm),
          .heading_10urad = std::max(a.heading_10urad, b.heading_10urad)};
}

constexpr bool is_imprecise(const Sigma& sigma) {
  return sigma.position_mm > kMaxSigmaMm || sigma.heading_10urad > kMaxSigmaHeading;
}

// Whether a message may follow another one of its run, by their clock.
constexpr Fate fate_after(const Message& before, const Message& message) {
  if (message.clock_us <= before.clock_us) {
    return Fate::kNotNewer;
  }
  return message.clock_us - before.clock_us < kMinSpacingUs ? Fate::kFlood : Fate::kUsed;
}

// Negative if time_us is before from_us.
constexpr std::int64_t difference_us(std::uint64_t time_us, std::uint64_t from_us) {
  return static_cast<std::int64_t>(time_us - from_us);
}

}  // namespace

Fate History::add(const Message& message, std::uint64_t arrival_us) {
  const Entry next{.message = message,
                   .offset_us = arrival_us - message.age_us - message.clock_us,
                   .residual = {}};
  if (!runs_.is_present(message.run)) {
    return runs_.is_past(message.run) && !is_silent(arrival_us) ? Fate::kPastRun
                                                                : take_candidate(next, arrival_us);
  }
  const Fate fate = fate_after(entry(0).message, message);
  if (fate == Fate::kFlood || (fate == Fate::kNotNewer && !is_silent(arrival_us))) {
    return fate;
  }
  if (fate == Fate::kNotNewer || has_leapt(entry(0), next)) {
    return take_candidate(next, arrival_us);
  }
  candidate_count_ = 0;  // the present sequence continues
  append(next);
  arrival_us_ = arrival_us;
  return Fate::kUsed;
}

// Whether no message came for kLostUs by the target's clock. A message that the target has not seen
// yet does not count.
bool History::is_silent(std::uint64_t arrival_us) const {
  return difference_us(arrival_us, arrival_us_) > std::int64_t{kLostUs};
}

// Compares a message only with the previous one, because the clocks drift apart if a drive is
// replayed much faster or slower than it was recorded.
bool History::has_leapt(const Entry& before, const Entry& next) {
  return difference_us(before.offset_us, next.offset_us) > std::int64_t{kMaxLeapUs};
}

// Candidates are consecutive messages of one run, each within kLostUs of the previous one. A
// message farther away in time, later or earlier, starts a new row. Otherwise a single message
// could keep its run waiting.
Fate History::take_candidate(const Entry& candidate, std::uint64_t arrival_us) {
  const Message& message = candidate.message;
  const Message& before = candidates_[candidate_count_ > 0 ? candidate_count_ - 1 : 0].message;
  const std::int64_t later_us = difference_us(message.clock_us, before.clock_us);
  const bool is_near = later_us <= std::int64_t{kLostUs} && later_us >= -std::int64_t{kLostUs};
  if (candidate_count_ == 0 || before.run != message.run || !is_near) {
    candidate_count_ = 0;
  } else if (const Fate fate = fate_after(before, message); fate != Fate::kUsed) {
    return fate;
  }
  candidates_[candidate_count_] = candidate;
  ++candidate_count_;
  if (candidate_count_ < kConfirmations) {
    return Fate::kUnconfirmed;
  }
  begin_course();
  arrival_us_ = arrival_us;
  return Fate::kUsed;
}

// Within one run, the previous sequence counts as lost: either it was silent, or by its own clock
// it is long past.
void History::begin_course() {
  const Message& first = candidates_[0].message;
  const bool is_of_present_run = runs_.is_present(first.run);
  if (!is_of_present_run) {
    runs_.begin(first.run);
    first_ = first.pose;
    has_moved_ = false;
  }
  if (count_ > 0 && !is_of_present_run) {
    break_off(Cause::kRestart, first.clock_us);
  } else if (unbroken_ > 0) {
    break_off(Cause::kLost, entry(0).message.clock_us);
  }
  count_ = 0;
  candidate_count_ = 0;
  stuck_.reset();
  floor_.reset();
  drifted_us_.reset();
  for (const Entry& candidate : candidates_) {
    append(candidate);
  }
}

void History::append(Entry next) {
  if (unbroken_ > 0) {
    const Message& before = entry(0).message;
    const std::uint64_t elapsed_us = next.message.clock_us - before.clock_us;
    if (elapsed_us > kLostUs) {
      break_off(Cause::kLost, before.clock_us);
    } else {
      const Motion mean = mean_of(motion_of(before), motion_of(next.message));
      next.residual = residual(next.message.pose, moved(before.pose, mean, elapsed_us));
      if (is_jump_to(next)) {
        break_off(Cause::kJump, next.message.clock_us);
        next.residual = {};
      }
    }
  }
  has_moved_ = has_moved_ || is_jump(residual(next.message.pose, first_));
  const bool is_held_back = is_drifting(next);
  const bool is_at_its_place = !is_stuck(next.message);
  if (is_at_its_place) {
    stuck_.reset();
  }
  const bool is_believed = is_at_its_place && !is_held_back;
  entries_[next_] = next;
  next_ = (next_ + 1) % kHistoryMessages;
  count_ = std::min(count_ + 1, kHistoryMessages);
  is_whole_ = is_whole_ && unbroken_ < kHistoryMessages;
  unbroken_ = is_believed ? std::min(unbroken_ + 1, kHistoryMessages) : 0;
}

// Predicting with the mean of both motions covers braking and the start of a bend. Small residuals
// then add up only if the poses shift slowly. If a source derives its speed from its own positions,
// the prediction already contains half of a jump. So a single step is also compared with the motion
// known before it.
bool History::is_jump_to(const Entry& next) const {
  const Message& before = entry(0).message;
  const std::uint64_t elapsed_us = next.message.clock_us - before.clock_us;
  if (elapsed_us <= kLateUs &&
      is_jump(residual(next.message.pose, moved(before.pose, motion_of(before), elapsed_us)))) {
    return true;
  }
  Residual sum = next.residual;
  for (std::size_t age = 0; age < unbroken_; ++age) {
    if (next.message.clock_us - entry(age).message.clock_us >= kLostUs) {
      break;
    }
    sum += entry(age).residual;
  }
  return is_jump(sum);
}

void History::break_off(Cause cause, std::uint64_t since_us) {
  ++epoch_;
  Tally& tally = breaks_[static_cast<std::size_t>(cause)];
  ++tally.times;
  tally.since_us = since_us;
  began_by_ = cause;
  unbroken_ = 0;
  is_whole_ = true;
  floor_.reset();
}

void History::pass(std::uint64_t now_us) {
  if (unbroken_ == 0) {
    return;
  }
  const std::uint64_t newest_us = entry(0).message.clock_us;
  if (now_us > newest_us && now_us - newest_us > kLostUs) {
    break_off(Cause::kLost, newest_us);
  }
}

void History::pass_silence(std::uint64_t target_us) {
  if (unbroken_ > 0) {
    pass(target_us - entry(0).offset_us);
  }
}

void History::contradict() {
  if (unbroken_ > 0) {
    stuck_ = entry(0).message;
    break_off(Cause::kContradicted, stuck_->clock_us);
  }
}

bool History::is_stuck(const Message& next) const {
  return stuck_ && next.clock_us - stuck_->clock_us <= kMaxStuckUs &&
         !is_jump(residual(next.pose, stuck_->pose));
}

// Whether poses arrive later and later. The floor is a line below all offsets that rises as fast as
// clocks may drift. The delay is the least offset of the last second minus the floor. After a break
// the floor starts at the present offset, so a constant delay, or one message that came too early,
// blinds the target for kSettledUs only.
bool History::is_drifting(const Entry& next) {
  if (!depends_on_arrival_) {
    return false;
  }
  const std::uint64_t now_us = next.message.clock_us;
  const auto above_floor = [&](std::uint64_t offset_us) {
    const std::uint64_t drift_us = (now_us - floor_->message.clock_us) * kMaxDriftPpm / 1'000'000;
    return difference_us(offset_us, floor_->offset_us + drift_us);
  };
  if (!floor_ || above_floor(next.offset_us) < 0) {
    floor_ = next;
  }
  if (above_floor(least_offset_us(next, 0)) > kMaxDelayGrowthUs) {
    if (unbroken_ > 0) {
      break_off(Cause::kDrifting, now_us);
    }
    floor_ = next;
    drifted_us_ = now_us;
  }
  if (drifted_us_ && now_us - *drifted_us_ >= kSettledUs) {
    drifted_us_.reset();
  }
  return drifted_us_.has_value();
}

Cause History::cause_before_the_oldest() const { return is_whole_ ? began_by_ : Cause::kLate; }

Placed History::pose_at(std::uint64_t time_us) const {
  std::size_t age = 0;
  while (age < unbroken_ && entry(age).message.clock_us > time_us) {
    ++age;
  }
  if (age == unbroken_) {
    return {.cause = cause_before_the_oldest()};
  }
  const Message& before = entry(age).message;
  const Message& after = age == 0 ? before : entry(age - 1).message;
  const std::uint64_t since_us = time_us - before.clock_us;
  const bool is_late = since_us > kLateUs && (age == 0 || after.clock_us - time_us > kLateUs);
  const Sigma sigma = larger_of(before.sigma, after.sigma);
  if (is_late || is_imprecise(sigma)) {
    return {.cause = is_late ? Cause::kLate : Cause::kImprecise};
  }
  return {.cause = Cause::kNone,
          .pose = age == 0 ? moved(before.pose, motion_of(before), since_us)
                           : between(before.pose, after.pose, since_us,
                                     after.clock_us - before.clock_us),
          .sigma = sigma};
}

std::optional<std::uint64_t> History::source_time(std::uint64_t target_us) const {
  if (unbroken_ == 0) {
    return std::nullopt;
  }
  return target_us - least_offset_us(entry(0), 1);
}

// The least offset of `newest` and of the entries in the second before it. first_age: age of the
// newest of these entries. Offsets are compared relative to `newest` modulo 2^64, so the zero
// points of the clocks do not matter.
std::uint64_t History::least_offset_us(const Entry& newest, std::size_t first_age) const {
  std::int64_t least_later = 0;
  for (std::size_t age = first_age; age < count_; ++age) {
    if (newest.message.clock_us - entry(age).message.clock_us > kLostUs) {
      break;
    }
    least_later = std::min(least_later, difference_us(entry(age).offset_us, newest.offset_us));
  }
  return newest.offset_us + static_cast<std::uint64_t>(least_later);
}

}  // namespace iog::pose
