#include "tools/simulate/drives/pose_source.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "numeric/elementary.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/simulate/random.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kPoseStream = 8;
constexpr std::uint32_t kLeastAgeUs = 2'000;
constexpr std::size_t kAgeSpanUs = 1'000;

// The angle of a direction, -pi ... pi: Newton's steps for sin(angle - guess) = 0, from the middle
// of its quadrant. The C library's atan2() is not the same on every machine.
double angle_of(double cos, double sin) {
  const double quarter = numeric::kPi / 4;
  double angle = cos >= 0 ? (sin >= 0 ? quarter : -quarter) : (sin >= 0 ? 3 : -3) * quarter;
  for (int i = 0; i < 5; ++i) {
    angle += sin * numeric::cos(angle) - cos * numeric::sin(angle);
  }
  return angle;
}

// An error that wanders.
class Wander {
 public:
  // sigma: of its change during a second. step_s: between two draws.
  Wander(double sigma, double step_s, Random& random)
      : memory_(numeric::exp(-step_s)),
        stationary_(sigma / std::sqrt(2 * (1 - numeric::exp(-1)))),
        fresh_(stationary_ * std::sqrt(1 - memory_ * memory_)),
        error_(stationary_ * random.bell()) {}

  double next(Random& random) {
    const double now = error_;
    error_ = memory_ * error_ + fresh_ * random.bell();
    return now;
  }

 private:
  double memory_;
  double stationary_;  // its own standard deviation
  double fresh_;
  double error_;
};

bool is_in_gap(const PoseOptions& options, double time_s) {
  return std::ranges::any_of(options.gaps, [&](const PoseOptions::Gap& gap) {
    return time_s >= gap.begin_s && time_s < gap.begin_s + gap.length_s;
  });
}

// By how much all jumps and swings have moved the position.
Vector3 moved_aside(const Scene& scene, const PoseOptions& options, double time_s) {
  Vector3 sum;
  const auto add = [&](double from_s, double metres) {
    const Placement at = scene.ego_at(from_s).at;
    sum.x -= metres * at.sin;
    sum.y += metres * at.cos;
  };
  for (const PoseOptions::Jump& jump : options.jumps) {
    if (time_s >= jump.time_s) {
      add(jump.time_s, jump.metres);
    }
  }
  for (const PoseOptions::Swing& swing : options.swings) {
    if (time_s >= swing.begin_s) {
      const double turns = (time_s - swing.begin_s) / swing.period_s;
      add(swing.begin_s, swing.metres / 2 * numeric::sin(2 * numeric::kPi * turns));
    }
  }
  return sum;
}

PoseSample stuck_pose(const Scene& scene, const PoseOptions& options, double time_s) {
  for (const PoseOptions::Freeze& freeze : options.freezes) {
    if (time_s >= freeze.begin_s && time_s < freeze.begin_s + freeze.length_s) {
      PoseSample sample = true_pose(scene, freeze.begin_s);
      sample.speed_mps = 0;
      sample.yaw_rate_rps = 0;
      return sample;
    }
  }
  return true_pose(scene, time_s);
}

}  // namespace

PoseSample true_pose(const Scene& scene, double time_s) {
  constexpr double kMoment = 0.01;  // seconds
  const Placement at = scene.ego_at(time_s).at;
  // A drive is not known before its begin.
  const double before_s = std::max(time_s - kMoment / 2, 0.0);
  const Placement before = scene.ego_at(before_s).at;
  const Placement after = scene.ego_at(before_s + kMoment).at;
  const double way = (after.x - before.x) * at.cos + (after.y - before.y) * at.sin;
  const double turn = after.sin * before.cos - after.cos * before.sin;  // its sine
  return {.x_m = at.x,
          .y_m = at.y,
          .heading_rad = angle_of(at.cos, at.sin),
          .speed_mps = way / kMoment,
          .yaw_rate_rps = turn / kMoment};
}

std::vector<PoseSample> simulated_poses(const Scene& scene, const PoseOptions& options,
                                        std::uint64_t seed, double drive_s) {
  Random random(seed, kPoseStream);
  const auto first_run = static_cast<std::uint32_t>(random.next() >> 33) + 1;
  const double step_s = 1 / options.rate_hz;
  Wander x(options.sigma_m, step_s, random);
  Wander y(options.sigma_m, step_s, random);
  Wander heading(options.sigma_heading_rad, step_s, random);
  std::vector<PoseSample> samples;
  const auto count = static_cast<std::size_t>(std::max(drive_s * options.rate_hz, 0.0));
  for (std::size_t i = 0; i <= count; ++i) {
    const double time_s = static_cast<double>(i) / options.rate_hz;
    PoseSample sample = stuck_pose(scene, options, time_s);
    const Vector3 aside = moved_aside(scene, options, time_s);
    sample.time_us = kDriveStartUs + static_cast<std::uint64_t>(numeric::round(time_s * 1e6));
    sample.age_us = kLeastAgeUs + static_cast<std::uint32_t>(random.below(kAgeSpanUs));
    sample.run = first_run + static_cast<std::uint32_t>(std::ranges::count_if(
                                 options.restarts_s, [&](double at_s) { return at_s <= time_s; }));
    sample.x_m += aside.x + x.next(random);
    sample.y_m += aside.y + y.next(random);
    sample.heading_rad += heading.next(random);
    sample.speed_mps += options.sigma_m * random.bell();
    sample.yaw_rate_rps += options.sigma_heading_rad * random.bell();
    sample.sigma_m = options.sigma_m;
    sample.sigma_heading_rad = options.sigma_heading_rad;
    sample.map = options.map;
    if (!is_in_gap(options, time_s)) {
      samples.push_back(sample);
    }
  }
  return samples;
}

PoseFeed::PoseFeed(std::vector<PoseSample> samples, std::uint16_t udp_port)
    : samples_(std::move(samples)), udp_port_(udp_port) {}

std::vector<CapturedDatagram> PoseFeed::take_until(std::uint64_t time_us) {
  std::vector<CapturedDatagram> datagrams;
  while (next_ < samples_.size() && samples_[next_].time_us + samples_[next_].age_us <= time_us) {
    datagrams.push_back(encoder_.datagram_of(samples_[next_++]));
    datagrams.back().destination.port = udp_port_;
  }
  return datagrams;
}

std::vector<CapturedDatagram> with_poses(std::vector<CapturedDatagram> datagrams, PoseFeed& poses) {
  std::ranges::move(poses.take_until(datagrams.back().time_us), std::back_inserter(datagrams));
  std::ranges::stable_sort(datagrams, {}, &CapturedDatagram::time_us);
  return datagrams;
}

}  // namespace iog::tools
