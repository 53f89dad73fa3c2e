#include "tools/odometry/motion_check.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <iomanip>
#include <numbers>
#include <optional>
#include <sstream>
#include <utility>

#include "lidar/formats.hpp"
#include "pose/message.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kStretchUs = 1'000'000;
constexpr std::uint64_t kMostGapUs = 500'000;  // between poses
constexpr std::uint64_t kSpeedUs = 100'000;
constexpr double kLeastM = 5;
constexpr double kMovesM = 1;  // in a stretch; less may be noise
constexpr double kLeastOffRad = 0.15;
constexpr double kNoiseRad = 0.01;  // of the turn in a stretch
constexpr double kMostWayShare = 0.2;
constexpr double kMostTurnShare = 0.5;
constexpr double kMostDeg = 15;
// A stretch of check_of() with the two turns that begin it.
constexpr std::uint64_t kSampleUs = 1'400'000;
constexpr std::uint64_t kSamplesApartUs = 6'000'000;  // the first two; then ever more
constexpr std::uint64_t kMostSamples = 20;

double turn_between(const PoseSample& from, const PoseSample& to) {
  return std::remainder(to.heading_rad - from.heading_rad, 2 * std::numbers::pi);
}

// Between two poses.
std::optional<PoseSample> pose_at(std::span<const PoseSample> poses, std::uint64_t time_us) {
  const auto next = std::ranges::lower_bound(poses, time_us, {}, &PoseSample::time_us);
  if (next == poses.begin() || next == poses.end() ||
      next->time_us - (next - 1)->time_us > kMostGapUs) {
    return std::nullopt;
  }
  return between(*(next - 1), *next, time_us);
}

// Whether one step from pose to pose departs from the speed of all others by more than a car can,
// or is next to none while the lidar moves: their source has jumped, or frozen.
bool is_disturbed(std::span<const PoseSample> poses, std::uint64_t from_us, std::uint64_t to_us,
                  double lidar_m) {
  constexpr double kStands = 0.1;  // of the lidar's speed
  constexpr double kStepM = 0.3;
  constexpr double kStepMps = 5;
  constexpr double kStepRad = 0.1;
  constexpr double kStepRps = 0.5;
  const auto begin = std::ranges::upper_bound(poses, from_us, {}, &PoseSample::time_us);
  const auto end = std::ranges::lower_bound(begin, poses.end(), to_us, {}, &PoseSample::time_us);
  struct Way {
    double seconds = 0;
    double metres = 0;
    double radians = 0;
  };
  std::vector<Way> steps;
  Way all;
  for (auto to = begin; to <= end; ++to) {
    const PoseSample& from = *(to - 1);
    const Way step{.seconds = static_cast<double>(to->time_us - from.time_us) / 1e6,
                   .metres = std::hypot(to->x_m - from.x_m, to->y_m - from.y_m),
                   .radians = std::abs(turn_between(from, *to))};
    all = {all.seconds + step.seconds, all.metres + step.metres, all.radians + step.radians};
    steps.push_back(step);
  }
  const double least_mps =
      lidar_m >= kMovesM ? kStands * lidar_m * 1e6 / static_cast<double>(to_us - from_us) : 0;
  return steps.size() > 1 && std::ranges::any_of(steps, [&](const Way& step) {
           const double share = step.seconds / (all.seconds - step.seconds);
           return step.metres < least_mps * step.seconds ||
                  step.metres - (all.metres - step.metres) * share >
                      kStepM + kStepMps * step.seconds ||
                  step.radians - (all.radians - step.radians) * share >
                      kStepRad + kStepRps * step.seconds;
         });
}

// Forward, m/s, over the last kSpeedUs and more; nothing if there is no pose from before them.
std::optional<double> speed_of(std::span<const PoseSample> poses) {
  const auto before = std::ranges::find_if(
      poses.rbegin(), poses.rend(),
      [&](const PoseSample& pose) { return poses.back().time_us - pose.time_us >= kSpeedUs; });
  if (before == poses.rend()) {
    return std::nullopt;
  }
  const PoseSample& last = poses.back();
  const std::complex way(last.x_m - before->x_m, last.y_m - before->y_m);
  return (way * std::polar(1.0, -before->heading_rad)).real() * 1e6 /
         static_cast<double>(last.time_us - before->time_us);
}

void add_stretch(const Pose& lidar, const PoseSample& from, const PoseSample& to,
                 MotionCheck& check) {
  const std::complex seen(lidar.translation().x(), lidar.translation().y());
  const std::complex told =
      std::complex(to.x_m - from.x_m, to.y_m - from.y_m) * std::polar(1.0, -from.heading_rad);
  const double turn = turn_between(from, to);
  ++check.stretches;
  if (std::max(std::abs(seen), std::abs(told)) >= kMovesM) {
    check.lidar_m += std::abs(seen);
    check.poses_m += std::abs(told);
    check.product += seen * std::conj(told);
  }
  check.lidar_rad += std::abs(heading_rad(lidar));
  check.poses_rad += std::abs(turn);
  check.off_rad += std::abs(std::remainder(heading_rad(lidar) - turn, 2 * std::numbers::pi));
}

}  // namespace

MotionCheck check_of(std::span<const TurnPose> turns, std::span<const PoseSample> poses,
                     std::int64_t offset_us) {
  MotionCheck all;
  MotionCheck sound;
  const auto time_of = [&](const TurnPose& turn) {
    return turn.time_us - static_cast<std::uint64_t>(offset_us);
  };
  std::size_t first = 0;
  for (std::size_t i = 1; i < turns.size(); ++i) {
    if (!turns[i].is_sure || turns[i].time_us - turns[i - 1].time_us > kMostGapUs) {
      first = i;
    } else if (turns[i].time_us - turns[first].time_us >= kStretchUs) {
      const std::optional<PoseSample> from = pose_at(poses, time_of(turns[first]));
      const std::optional<PoseSample> to = pose_at(poses, time_of(turns[i]));
      if (from && to) {
        const Pose lidar = turns[first].pose.inverse() * turns[i].pose;
        add_stretch(lidar, *from, *to, all);
        if (!is_disturbed(poses, from->time_us, to->time_us,
                          lidar.translation().head<2>().norm())) {
          add_stretch(lidar, *from, *to, sound);
        }
      }
      first = i;
    }
  }
  return sound.lidar_m > 0 ? sound : all;
}

std::string words_of(const MotionCheck& check) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(0);
  const double most_m = std::max(check.lidar_m, check.poses_m);
  const double most_rad = std::max(check.lidar_rad, check.poses_rad);
  const double noise_rad = kNoiseRad * static_cast<double>(check.stretches);
  const double aside_deg = std::arg(check.product) / kRadians;
  if (most_m >= kLeastM && std::abs(check.lidar_m - check.poses_m) > kMostWayShare * most_m) {
    text << "the lidar moves " << check.lidar_m << " m and the poses " << check.poses_m << " m";
  } else if (check.off_rad > noise_rad + std::max(kLeastOffRad, kMostTurnShare * most_rad)) {
    text << "the lidar turns by " << check.lidar_rad / kRadians << " degrees and the poses by "
         << check.poses_rad / kRadians << ", not at the same times or to the same side";
  } else if (most_m >= kLeastM && std::abs(aside_deg) > kMostDeg) {
    text << "the lidar moves " << std::abs(aside_deg) << " degrees to the "
         << (aside_deg > 0 ? "left" : "right") << " of where the poses do";
  }
  return text.str();
}

MotionWatch::MotionWatch(const CatalogueEntry& car)
    : car_(&car),
      is_watched_(
          std::ranges::any_of(car.sensors, lidar::turns, &description::SensorConfig::format)) {}

void MotionWatch::take(const CapturedDatagram& datagram) {
  const std::uint16_t port = datagram.destination.port;
  const std::size_t sensor = sensor_of_port(*car_, port);
  if (!is_watched_) {
    return;
  }
  if (is_pose_port(*car_, port)) {
    take_pose(datagram);
  } else if (sensor < car_->sensors.size() && lidar::turns(car_->sensors[sensor].format)) {
    take_packet(datagram);
  }
}

void MotionWatch::take_pose(const CapturedDatagram& datagram) {
  const auto [fate, message] = pose::decode(datagram.payload);
  const std::uint64_t time_us =
      datagram.time_us - std::min<std::uint64_t>(message.age_us, datagram.time_us);
  if (fate != pose::Fate::kUsed || (!poses_.empty() && time_us <= poses_.back().time_us)) {
    return;
  }
  // Outside of a sample, the first pose and the last.
  spare_ = points_ ? 0 : spare_ + 1;
  if (spare_ > 2) {
    poses_.pop_back();
  }
  poses_.push_back({.time_us = time_us,
                    .x_m = message.pose.x_mm / 1e3,
                    .y_m = message.pose.y_mm / 1e3,
                    .heading_rad = message.pose.heading * (2 * std::numbers::pi / 0x1p32)});
}

// Without poses there is nothing to compare.
void MotionWatch::take_packet(const CapturedDatagram& datagram) {
  const std::uint64_t since_us = datagram.time_us - std::min(begin_us_, datagram.time_us);
  if (!points_ && !poses_.empty() && samples_ < kMostSamples &&
      (samples_ == 0 || since_us >= samples_ * kSamplesApartUs)) {
    begin_us_ = datagram.time_us;
    ++samples_;
    points_.emplace(*car_);
  } else if (points_ && since_us > kSampleUs) {
    points_.reset();
  }
  std::optional<Turn> turn = points_ ? points_->take(datagram) : std::nullopt;
  if (turn && (turns_.empty() || turn->end_us > turns_.back().time_us)) {
    turns_.push_back(odometry_.add(*std::move(turn), speed_of(poses_)));
  }
}

}  // namespace iog::tools
