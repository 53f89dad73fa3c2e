// Collects statistics of durations: the maximum, the sum and a histogram. The words have the same
// layout as in the stream (docs/spec.md 3.7).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace iog::health {

struct Durations {
  // The first bucket counts durations below 256 us. The upper limit doubles with each bucket. The
  // last bucket counts durations of at least 65,536 us.
  static constexpr std::size_t kBuckets = 10;
  static constexpr std::uint32_t kFirstBelowUs = 256;

  std::uint32_t worst_us = 0;
  std::uint32_t sum_us_high = 0;
  std::uint32_t sum_us_low = 0;
  std::array<std::uint32_t, kBuckets> counts{};  // modulo 2^32

  constexpr void add(std::uint32_t us) {
    worst_us = std::max(worst_us, us);
    const std::uint64_t sum = sum_us() + us;
    sum_us_high = static_cast<std::uint32_t>(sum >> 32);
    sum_us_low = static_cast<std::uint32_t>(sum);
    ++counts[bucket_of(us)];
  }

  [[nodiscard]] constexpr std::uint64_t sum_us() const {
    return std::uint64_t{sum_us_high} << 32 | sum_us_low;
  }
  [[nodiscard]] constexpr std::uint64_t count() const {
    return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  }

 private:
  static constexpr std::size_t bucket_of(std::uint32_t us) {
    constexpr std::size_t kFirstBits = std::bit_width(kFirstBelowUs - 1);
    const auto bits = static_cast<std::size_t>(std::bit_width(us));
    return std::min(bits - std::min(bits, kFirstBits), kBuckets - 1);
  }
};

}  // namespace iog::health
