// Ranges: speeds are within kMostSpeed, 1,600,000 sixteenths. With an innovation below 2^17, a gain
// of the speed below 2^31 gives less than 2^48, a gain of the place less than 2^33. Places have 64
// bits.
#include "objects/track.hpp"

#include <algorithm>

#include "numeric/square_root.hpp"

namespace iog::objects {
namespace {

constexpr std::int32_t within_most(std::int64_t speed) {
  constexpr std::int64_t kMost = std::int64_t{kMostSpeed} * 16;
  return static_cast<std::int32_t>(std::clamp(speed, -kMost, kMost));
}

constexpr std::int32_t mean(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>((std::int64_t{a} + b) / 2);
}

}  // namespace

void Track::begin(std::uint32_t its_id, const Box& box, std::uint64_t now_us) {
  *this = {};
  state = State::kYoung;
  id = its_id;
  updates = 1;
  born_us = now_us;
  seen_us = now_us;
  x_ = std::int64_t{box.at.x_mm} << kFine;
  y_ = std::int64_t{box.at.y_mm} << kFine;
  box_ = box;
  covariances_.fill({kBirthPlaceMm * kBirthPlaceMm, 0, kBirthSpeed * kBirthSpeed});
  know_speed();
}

void Track::predict(Step step) {
  x_ += step.of(vx_);
  y_ += step.of(vy_);
  place();
  const bool is_little = is_small();
  const std::int32_t across = is_little                ? kWanderSmall
                              : !has_heading_          ? kWanderAlong
                              : speed_ >= kWheelsSpeed ? kWanderAcrossFast
                                                       : kWanderAcross;
  covariances_[kAlong].predict(step, is_little ? kWanderSmall : kWanderAlong);
  covariances_[kAcross].predict(step, across);
  know_speed();
}

void Track::correct(Side side, Covariance::Gain gain, std::int32_t innovation_mm,
                    std::int32_t most_change) {
  const Direction axis = side_of(box_.along, side);
  const std::int64_t way = std::int64_t{gain.place} * innovation_mm >> (16 - kFine);
  const std::int64_t most = std::int64_t{most_change} << kFine;
  const std::int64_t more =
      std::clamp(std::int64_t{gain.speed} * innovation_mm >> (16 - kFine), -most, most);
  x_ += way * axis.x >> kDirectionBits;
  y_ += way * axis.y >> kDirectionBits;
  vx_ = within_most(vx_ + (more * axis.x >> kDirectionBits));
  vy_ = within_most(vy_ + (more * axis.y >> kDirectionBits));
  place();
  know_speed();
}

void Track::fade_across() {
  const Direction axis = side_of(box_.along, kAcross);
  const std::int64_t across =
      (std::int64_t{vx_} * axis.x + std::int64_t{vy_} * axis.y) / (kWheelsShare << kDirectionBits);
  vx_ -= static_cast<std::int32_t>(across * axis.x >> kDirectionBits);
  vy_ -= static_cast<std::int32_t>(across * axis.y >> kDirectionBits);
  know_speed();
}

void Track::rest() {
  vx_ = 0;
  vy_ = 0;
  know_speed();
}

void Track::begin_heading(const Sides& sides) {
  box_.sides = sides;
  has_heading_ = true;
  const Covariance& a = covariances_[kAlong];
  const Covariance& b = covariances_[kAcross];
  covariances_.fill(
      {mean(a.place(), b.place()), mean(a.both(), b.both()), mean(a.speed(), b.speed())});
}

bool Track::is_mostly_standing() const {
  return !has_trail() && !is_sure_car() && seen.standing > seen.hits &&
         longest_of(box_.sides) >= kSmallMm && speed_ < kParkedSpeed;
}

bool Track::is_like_a_car() const {
  const std::int32_t along = box_.sides[kAlong].length();
  const std::int32_t across = box_.sides[kAcross].length();
  return has_heading_ && across >= kNarrowestCarMm && across <= kWidestCarMm &&
         along >= kShortestCarMm && along <= kLongestCarMm;
}

bool Track::is_sure_car() const {
  return confidence >= kSureConfidence && unopposed >= kSureUnopposed && is_like_a_car();
}

bool Track::is_streak() const {
  const std::int32_t narrow = std::min(box_.sides[kAlong].length(), box_.sides[kAcross].length());
  const std::int32_t length = longest_of(box_.sides);
  if (length < kSmallMm) {
    return seen.hits < kRowHits && narrow < kRowMm && length >= kShortestRowMm &&
           speed_ < kStreakSpeed;
  }
  if (seen.hits < kStreakHits && narrow < kStreakMm) {
    return true;
  }
  const bool are_walkers = seen.hits >= kStreakHits && speed_ < kGroupSpeed &&
                           seen.moving * 100 >= kGroupPercent * seen.hits;
  return !moves() && !are_walkers && seen.hits * kSparseMm < length && narrow < kWidestSparseMm &&
         speed_ < kStreakSpeed;
}

void Track::look_from(Point car) {
  const Velocity its = velocity();
  const std::int64_t away = std::int64_t{its.x} * (box_.at.x_mm - car.x_mm) +
                            std::int64_t{its.y} * (box_.at.y_mm - car.y_mm);
  is_receding = speed_ >= kMoveSpeed && 2 * away > std::int64_t{speed_} * range_mm(car, box_.at);
}

bool Track::may_have_a_standing_face() const {
  return is_receding && longest_of(box_.sides) >= kSmallMm;
}

void Track::follow_trail() {
  const bool is_seen = seen.passed >= kTrailPlaces && seen.passed >= kGoodOverBad * seen.kept;
  trail = std::clamp<std::int32_t>(trail + (is_seen ? 2 : -1), 0, kMostTrail);
}

bool Track::is_small() const { return longest_of(box_.sides) < kSmallMm && speed_ < kSmallSpeed; }

void Track::place() {
  box_.at = {static_cast<std::int32_t>(x_ >> kFine), static_cast<std::int32_t>(y_ >> kFine)};
}

void Track::know_speed() {
  const Velocity its = velocity();
  speed_ = static_cast<std::int32_t>(numeric::square_root(
      static_cast<std::uint64_t>(std::int64_t{its.x} * its.x + std::int64_t{its.y} * its.y)));
  speed_deviation_ = static_cast<std::int32_t>(numeric::square_root(static_cast<std::uint64_t>(
      std::int64_t{covariances_[kAlong].speed()} + covariances_[kAcross].speed())));
}

}  // namespace iog::objects
