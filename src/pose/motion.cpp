// The bounds of all intermediates, from those of pose/limits.hpp and elapsed <= 10^6 us:
//   angle:     yaw * elapsed <= 10^13 prad, in nrad <= 10^10; times 683,565,276 < 6.9 * 10^18
//   distance:  speed * elapsed * 16 <= 1.6 * 10^12, in 2^-10 mm <= 1.03 * 10^8; times 2^30 < 2^57
//   between:   a difference is below 2^31 (of positions 2 * 10^9), times elapsed below 2^51
// Each is below 2^63, with room for the half that rounds.
#include "pose/motion.hpp"

#include "numeric/division.hpp"
#include "numeric/rotation.hpp"
#include "pose/limits.hpp"

namespace iog::pose {
namespace {

using numeric::div_nearest;

// In 2^-32 turns.
std::int64_t angle_turned(std::int32_t yaw_urad_per_s, std::int64_t elapsed_us) {
  const std::int64_t nanoradians = div_nearest<std::int64_t>(yaw_urad_per_s * elapsed_us, 1'000);
  return div_nearest<std::int64_t>(nanoradians * kAnglePerRadian, 1'000'000'000);
}

// A length in 2^-10 mm times a cosine in 2^-30, rounded to the nearest millimetre; ties round up.
std::int32_t component_mm(std::int64_t length, std::int32_t cosine_q30) {
  constexpr int kFractionBits = 10 + numeric::kSineFractionBits;
  constexpr std::int64_t kHalf = std::int64_t{1} << (kFractionBits - 1);
  return static_cast<std::int32_t>((length * cosine_q30 + kHalf) >> kFractionBits);
}

std::int32_t turn_between(std::uint32_t from, std::uint32_t to) {
  return static_cast<std::int32_t>(to - from);
}

}  // namespace

Pose moved(const Pose& pose, const Motion& motion, std::uint64_t elapsed_us) {
  const auto elapsed = static_cast<std::int64_t>(elapsed_us);
  const std::int64_t turned = angle_turned(motion.yaw_urad_per_s, elapsed);
  // mm/s times us is 10^-6 mm, and 16 / 15625 of that is 2^-10 mm.
  const std::int64_t length =
      div_nearest<std::int64_t>(motion.speed_mm_per_s * elapsed * 16, 15'625);
  const numeric::Rotation chord =
      numeric::rotation_of(pose.heading + static_cast<std::uint32_t>(turned >> 1));
  return {.x_mm = pose.x_mm + component_mm(length, chord.cos_q30),
          .y_mm = pose.y_mm + component_mm(length, chord.sin_q30),
          .heading = pose.heading + static_cast<std::uint32_t>(turned)};
}

Pose between(const Pose& from, const Pose& to, std::uint64_t elapsed_us, std::uint64_t span_us) {
  const auto part = [&](std::int64_t whole) {
    return static_cast<std::int32_t>(div_nearest<std::int64_t>(
        whole * static_cast<std::int64_t>(elapsed_us), static_cast<std::int64_t>(span_us)));
  };
  const std::int32_t turned = part(turn_between(from.heading, to.heading));
  return {.x_mm = from.x_mm + part(std::int64_t{to.x_mm} - from.x_mm),
          .y_mm = from.y_mm + part(std::int64_t{to.y_mm} - from.y_mm),
          .heading = from.heading + static_cast<std::uint32_t>(turned)};
}

Residual residual(const Pose& pose, const Pose& predicted) {
  return {.x_mm = std::int64_t{pose.x_mm} - predicted.x_mm,
          .y_mm = std::int64_t{pose.y_mm} - predicted.y_mm,
          .heading = turn_between(predicted.heading, pose.heading)};
}

// Sums are below 2^52, so only small ones are squared.
bool is_jump(const Residual& sum) {
  const auto is_above = [](std::int64_t value, std::int64_t most) {
    return value > most || value < -most;
  };
  return is_above(sum.x_mm, kMaxResidualMm) || is_above(sum.y_mm, kMaxResidualMm) ||
         sum.x_mm * sum.x_mm + sum.y_mm * sum.y_mm > kMaxResidualMm * kMaxResidualMm ||
         is_above(sum.heading, kMaxResidualAngle);
}

}  // namespace iog::pose
