#include "tools/mount/motion_log.hpp"

#include <algorithm>
#include <cmath>

#include "pose/message.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kAroundUs = 500'000;
constexpr double kSlowest = 2;           // m/s
constexpr double kMostAcceleration = 1;  // m/s^2

}  // namespace

void MotionLog::add(std::uint64_t time_us, std::span<const std::byte> payload) {
  const pose::Decoded decoded = pose::decode(payload);
  if (decoded.fate == pose::Fate::kUsed) {
    samples_.push_back({.time_us = time_us,
                        .speed = decoded.message.speed_mm_per_s / 1000.0,
                        .yaw_rate = decoded.message.yaw_urad_per_s / 1e6});
  }
}

void MotionLog::sort() { std::ranges::stable_sort(samples_, {}, &Sample::time_us); }

// Of the samples within half a second: mean of speed and turn, and the slope of the speed.
CarState MotionLog::at(std::uint64_t time_us) const {
  const auto first = std::ranges::lower_bound(samples_, time_us - std::min(time_us, kAroundUs), {},
                                              &Sample::time_us);
  const auto end = std::ranges::upper_bound(samples_, time_us + kAroundUs, {}, &Sample::time_us);
  const std::span<const Sample> near(first, end);
  if (near.empty()) {
    return CarState::kUnknown;
  }
  double n = 0, t = 0, v = 0, tt = 0, tv = 0, turn = 0;
  for (const Sample& sample : near) {
    const double at_s = (static_cast<double>(sample.time_us) - static_cast<double>(time_us)) / 1e6;
    n += 1;
    t += at_s;
    v += sample.speed;
    tt += at_s * at_s;
    tv += at_s * sample.speed;
    turn += sample.yaw_rate;
  }
  const double spread = n * tt - t * t;
  const double gain = spread > 0 ? (n * tv - t * v) / spread : 0;
  const double speed = v / n;
  if (std::abs(speed) < kSlowest) {
    return CarState::kStands;
  }
  const bool leans =
      std::abs(gain) > kMostAcceleration || std::abs(speed * turn / n) > kMostAcceleration;
  return leans ? CarState::kLeans : CarState::kDrives;
}

}  // namespace iog::tools
