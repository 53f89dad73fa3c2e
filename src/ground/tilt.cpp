// Ranges. There are n <= 128 samples with x < 1875. A sample that counts is at most 832 mm high in
// the first round, and at most 100 + 1201 + 100 in the second, so |y| < 2^11. So the sums of x, y,
// x^2 and xy stay below 2^29. n sum(x^2), n sum(xy) and their differences to the products of sums
// stay below 2^37, and 1024 times that below 2^47.
#include "ground/tilt.hpp"

#include <algorithm>

namespace iog::ground {
namespace {

constexpr std::int32_t kMostSlope = 656;
constexpr std::int32_t kMostUpMm = 100;
constexpr std::int32_t kNearMm = 100;    // a sample this close to the line counts,
constexpr std::int32_t kNearRise = 100;  // in the first round plus this many 2^-12 of its distance
constexpr std::int32_t kFitsMm = 80;     // a sample this close is explained by the line
constexpr std::int64_t kLeastSpread = 900;  // variance of x, (16 mm)^2: 0.48 m

struct Sums {
  std::int32_t n = 0;
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t xx = 0;
  std::int32_t xy = 0;
};

// floor(a / b), but at most `most` and at least -most. b > 0, |a| < 2^62, b < 2^52, most < 1024.
std::int32_t quotient_within(std::int64_t a, std::int64_t b, std::int32_t most) {
  constexpr int kBits = 10;
  // Rounding down moves a negative value away from 0.
  std::int64_t rest = a < 0 ? -a + b - 1 : a;
  std::int32_t quotient = 0;
  for (int bit = kBits - 1; bit >= 0; --bit) {
    if (rest >= b << bit) {
      rest -= b << bit;
      quotient += 1 << bit;
    }
  }
  quotient = std::min(quotient, most);
  return a < 0 ? -quotient : quotient;
}

Sums sums_near(std::span<const Sample> samples, Tilt tilt, std::int32_t near_rise) {
  Sums sums;
  for (const Sample sample : samples) {
    const auto along_mm = static_cast<std::int32_t>(sample.along_mm());
    const std::int32_t off = sample.height_mm - tilt.at(sample.along_mm());
    const std::int32_t near = kNearMm + ((near_rise * along_mm) >> 12);
    if (off <= near && off >= -near) {
      const std::int32_t x = sample.along_16_mm;
      const std::int32_t y = sample.height_mm;
      ++sums.n;
      sums.x += x;
      sums.y += y;
      sums.xx += x * x;
      sums.xy += x * y;
    }
  }
  return sums;
}

// Least-squares line.
Tilt fit(const Sums& sums, std::int32_t fewest) {
  const std::int64_t n = sums.n;
  const std::int64_t spread = sums.xx * n - std::int64_t{sums.x} * sums.x;
  if (sums.n < fewest || spread <= n * n * kLeastSpread) {
    return {};
  }
  const std::int64_t common = sums.xy * n - std::int64_t{sums.x} * sums.y;
  const std::int32_t slope = quotient_within(common * 1024, spread, kMostSlope);
  const std::int64_t rest = sums.y - ((std::int64_t{slope} * sums.x) >> 10);
  return {.up_mm = quotient_within(rest, n, kMostUpMm), .slope = slope};
}

std::int32_t count_explained(std::span<const Sample> samples, Tilt tilt) {
  std::int32_t count = 0;
  for (const Sample sample : samples) {
    const std::int32_t off = sample.height_mm - tilt.at(sample.along_mm());
    count += off <= kFitsMm && off >= -kFitsMm ? 1 : 0;
  }
  return count;
}

}  // namespace

void Samples::add(std::uint32_t along_mm, std::int32_t height_mm) {
  if (along_mm >= kFirstSampleMm && along_mm < kEndOfSamplesMm && count_ < kMost) {
    samples_[count_++] = {.along_16_mm = static_cast<std::uint16_t>(along_mm >> 4),
                          .height_mm = static_cast<std::int16_t>(
                              std::clamp<std::int32_t>(height_mm, -32'767, 32'767))};
  }
}

Tilt tilt_of(std::span<const Sample> samples, std::int32_t fewest) {
  const Tilt first = fit(sums_near(samples, {}, kNearRise), fewest);
  const Tilt tilt = fit(sums_near(samples, first, 0), fewest);
  const std::int32_t before = count_explained(samples, {});
  return count_explained(samples, tilt) >= before + before / 8 ? tilt : Tilt{};
}

}  // namespace iog::ground
