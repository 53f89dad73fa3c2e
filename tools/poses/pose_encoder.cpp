#include "tools/poses/pose_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "numeric/elementary.hpp"
#include "pose/limits.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

// The value in so many units, to the nearest, if it is at most `most` of them.
std::int32_t units_of(double value, double units, std::int32_t most, const char* what) {
  const double scaled = value * units;
  if (!(std::abs(scaled) <= most)) {
    throw UsageError("a pose with a " + std::string(what) + " of " + std::to_string(value) +
                     ": the target takes at most " + std::to_string(most / units));
  }
  return static_cast<std::int32_t>(numeric::round(scaled));
}

// Upwards: a source never seems more certain than it is. A sigma that is no number is none at all.
std::uint16_t sigma_of(double value, double units) {
  constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
  constexpr double kAlmost = 1e-6;  // of a unit: what is left of a product that should be whole
  const double scaled = std::ceil(value * units - kAlmost);
  return static_cast<std::uint16_t>(scaled >= 1 ? std::min(scaled, kMost)
                                                : (scaled < 1 ? 1.0 : kMost));
}

constexpr double kMaxHeadingRad = 1e9;

std::uint32_t binary_angle(double radians) {
  if (!(std::abs(radians) < kMaxHeadingRad)) {
    throw UsageError("a pose without a heading");
  }
  const double turns = radians / (2 * numeric::kPi);
  const double part = turns - std::floor(turns);
  // Rounded to 2^32 it is 0 again.
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(numeric::round(part * 0x1p32)));
}

}  // namespace

bool can_be_said(const PoseSample& sample) {
  const auto within = [](double value, double units, std::int32_t most) {
    return std::abs(value * units) <= most;
  };
  return within(sample.x_m, 1000, pose::kMaxCoordinateMm) &&
         within(sample.y_m, 1000, pose::kMaxCoordinateMm) &&
         within(sample.speed_mps, 1000, pose::kMaxSpeedMmPerS) &&
         within(sample.yaw_rate_rps, 1'000'000, pose::kMaxYawRateUradPerS) &&
         std::abs(sample.heading_rad) < kMaxHeadingRad;
}

pose::Pose wire_pose(double x_m, double y_m, double heading_rad) {
  return {.x_mm = units_of(x_m, 1000, pose::kMaxCoordinateMm, "coordinate"),
          .y_mm = units_of(y_m, 1000, pose::kMaxCoordinateMm, "coordinate"),
          .heading = binary_angle(heading_rad)};
}

pose::Sigma wire_sigma(double position_m, double heading_rad) {
  return {.position_mm = sigma_of(position_m, 1000),
          .heading_10urad = sigma_of(heading_rad, 100'000)};
}

pose::Message message_of(const PoseSample& sample) {
  if (sample.age_us > pose::kMaxAgeUs) {
    throw UsageError("a pose that is sent " + std::to_string(sample.age_us) +
                     " us after its measurement: the target takes at most " +
                     std::to_string(pose::kMaxAgeUs));
  }
  return {.run = sample.run,
          .age_us = sample.age_us,
          .clock_us = sample.time_us,
          .pose = wire_pose(sample.x_m, sample.y_m, sample.heading_rad),
          .sigma = wire_sigma(sample.sigma_m, sample.sigma_heading_rad),
          .speed_mm_per_s = units_of(sample.speed_mps, 1000, pose::kMaxSpeedMmPerS, "speed"),
          .yaw_urad_per_s =
              units_of(sample.yaw_rate_rps, 1'000'000, pose::kMaxYawRateUradPerS, "yaw rate"),
          .map = sample.map};
}

CapturedDatagram PoseEncoder::datagram_of(const PoseSample& sample) {
  if (sample.run != run_) {
    encoder_ = pose::Encoder();
    run_ = sample.run;
  }
  const auto bytes = encoder_.encode(message_of(sample));
  return {.time_us = sample.time_us + sample.age_us,
          .source = {kPoseSourceIpv4, pose::kPosePort},
          .destination = {kTargetIpv4, pose::kPosePort},
          .payload = {bytes.begin(), bytes.end()}};
}

}  // namespace iog::tools
