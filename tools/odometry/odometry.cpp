#include "tools/odometry/odometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace iog::tools {
namespace {

constexpr double kMapReachM = 120;
constexpr double kMapEdgeM = 0.5;
constexpr double kScanEdgeM = 1.5;
constexpr double kLongestTurnS = 0.5;
// Each round straightens the turn by the motion that the round before has found.
constexpr int kRounds = 2;
constexpr int kFirstRounds = 4;

// The first map is of one turn, in which posts and kerbs repeat every few metres.
constexpr std::array kStartsMps{0.0, 10.0, 20.0, 30.0, 40.0};
constexpr double kClearlyBetter = 1.5;
constexpr double kConfirmsMps = 1;

// Predictions: off by the car's acceleration, and in a map of one turn by anything.
constexpr double kAccelerationMps2 = 5;
constexpr double kTurnAccelerationRps2 = 1;
constexpr Doubt kFirstDoubt{.most_m = 1, .sigma_m = 5, .sigma_rad = 0.2};
constexpr double kLeastOffM = 0.3;
constexpr double kCountedOffM = 0.1;
constexpr double kOffAtM = 50;

// Well-determined motions have a support of 0.03 or more and an agreement of 0.4 or more, in a map
// of one turn of 0.25, and no car accelerates so much. In a tunnel and on an empty plain the
// support is below 0.01. A desk has 55 points half a metre apart, a street more than 2,000.
constexpr double kLeastSupport = 0.02;
constexpr double kLeastAgreement = 0.3;
constexpr double kLeastFirstAgreement = 0.2;
constexpr double kFewestAgreeing = 100;
constexpr double kMostAccelerationMps2 = 30;

// The points where they would have been measured at the turn's end.
std::vector<Eigen::Vector3d> straightened(const Turn& turn, const Pose& motion, double seconds) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(turn.points.size());
  Pose back = Pose::Identity();
  std::uint64_t at_us = turn.end_us;
  for (const TimedPoint& point : turn.points) {
    if (point.time_us != at_us) {
      at_us = point.time_us;
      back = part_of(motion, -static_cast<double>(turn.end_us - at_us) / 1e6 / seconds);
    }
    points.push_back(back * point.place);
  }
  return points;
}

template <typename Point>
std::vector<Point> some_of(const std::vector<Point>& points,
                           const std::vector<std::size_t>& which) {
  std::vector<Point> some;
  some.reserve(which.size());
  for (const std::size_t i : which) {
    some.push_back(points[i]);
  }
  return some;
}

std::vector<Eigen::Vector3d> few_of(const std::vector<Eigen::Vector3d>& points) {
  return some_of(points, thinned(points, kScanEdgeM));
}

// Most surfaces look alike after any motion along them. The others decide.
double worth_of(const ScanMatch& match) { return match.agreement * match.least_support; }

Pose forward(double metres) { return Pose(Eigen::Translation3d(metres, 0, 0)); }

}  // namespace

Pose part_of(const Pose& motion, double part) {
  const Eigen::AngleAxisd turn(motion.linear());
  Pose some(Eigen::AngleAxisd(turn.angle() * part, turn.axis()));
  some.translation() = motion.translation() * part;
  return some;
}

void Odometry::insert(const Turn& turn, const Pose& pose, const Pose& motion) {
  std::vector<Eigen::Vector3d> points = straightened(turn, motion, seconds_);
  for (Eigen::Vector3d& point : points) {
    point = pose * point;
  }
  map_.add(points);
  map_.forget_beyond(pose.translation(), kMapReachM);
}

double Odometry::most_off_m() const {
  return off_count_ == 0 ? kFirstDoubt.most_m
                         : std::max(kLeastOffM, 3 * std::sqrt(squares_off_ / off_count_));
}

void Odometry::learn(const Pose& off) {
  const double off_m = off.translation().norm() +
                       2 * kOffAtM * std::sin(Eigen::AngleAxisd(off.linear()).angle() / 2);
  if (off_m > kCountedOffM) {
    squares_off_ += off_m * off_m;
    ++off_count_;
  }
}

ScanMatch Odometry::matched(const Turn& turn, const Pose& predicted) const {
  const Doubt doubt{.most_m = most_off_m(),
                    .sigma_m = kAccelerationMps2 * seconds_ * seconds_,
                    .sigma_rad = kTurnAccelerationRps2 * seconds_ * seconds_};
  Pose motion = predicted;
  ScanMatch match;
  for (int round = 0; round < kRounds; ++round) {
    match =
        match_scan(few_of(straightened(turn, motion, seconds_)), map_, pose_ * predicted, doubt);
    motion = pose_.inverse() * match.pose;
  }
  return match;
}

// Both turns are straightened by what the rounds lead to.
ScanMatch Odometry::matched_at(double speed_mps, const Turn& turn) {
  Pose motion = forward(speed_mps * seconds_);
  ScanMatch match;
  for (int round = 0; round < kFirstRounds; ++round) {
    map_ = {};
    insert(last_, pose_, motion);
    match =
        match_scan(few_of(straightened(turn, motion, seconds_)), map_, pose_ * motion, kFirstDoubt);
    motion = pose_.inverse() * match.pose;
  }
  return match;
}

// The start of kStartsMps whose match is clearly better than those before it.
ScanMatch Odometry::best_start(const Turn& turn) {
  ScanMatch best;
  for (const double speed : kStartsMps) {
    const ScanMatch match = matched_at(speed, turn);
    best = speed == 0 || worth_of(match) > kClearlyBetter * worth_of(best) ? match : best;
  }
  return best;
}

ScanMatch Odometry::matched_first(const Turn& turn, std::optional<double> likely_mps) {
  ScanMatch match = likely_mps ? matched_at(*likely_mps, turn) : best_start(turn);
  const double found_mps = (pose_.inverse() * match.pose).translation().x() / seconds_;
  const bool is_sound =
      match.least_support >= kLeastSupport && match.agreement >= kLeastFirstAgreement;
  if (likely_mps && !(is_sound && std::abs(found_mps - *likely_mps) < kConfirmsMps)) {
    match = best_start(turn);
  }
  map_ = {};
  insert(last_, pose_, pose_.inverse() * match.pose);
  return match;
}

TurnPose Odometry::add(Turn turn, std::optional<double> likely_mps) {
  std::vector<Eigen::Vector3d> places;
  for (const TimedPoint& point : turn.points) {
    places.push_back(point.place);
  }
  turn.points = some_of(turn.points, thinned(places, kMapEdgeM));
  const double seconds = static_cast<double>(turn.end_us - last_.end_us) / 1e6;
  if (turns_ > 0 && seconds > kLongestTurnS) {
    turns_ = 0;
  }
  TurnPose found{.time_us = turn.end_us, .pose = pose_, .is_sure = last_.end_us == 0};
  if (turns_ > 0) {
    const Pose predicted = turns_ == 1 ? Pose::Identity() : part_of(motion_, seconds / seconds_);
    seconds_ = seconds;
    found.match = turns_ == 1 ? matched_first(turn, likely_mps) : matched(turn, predicted);
    motion_ = pose_.inverse() * found.match.pose;
    found.is_sure =
        found.match.least_support >= kLeastSupport &&
        found.match.agreement >= (turns_ == 1 ? kLeastFirstAgreement : kLeastAgreement) &&
        found.match.agreement * static_cast<double>(turn.points.size()) >= kFewestAgreeing;
    if (turns_ > 1) {
      const Pose off = predicted.inverse() * motion_;
      found.is_sure =
          found.is_sure && off.translation().norm() < kMostAccelerationMps2 * seconds * seconds;
      learn(off);
    }
    pose_ = found.pose = found.match.pose;
    insert(turn, pose_, motion_);
  }
  last_ = std::move(turn);
  ++turns_;
  return found;
}

}  // namespace iog::tools
