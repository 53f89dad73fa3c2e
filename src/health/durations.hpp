// How long something took, of many times: the worst, their sum, and how many took how long.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace iog::health {

class Durations {
 public:
  // The first counts what is below 256 us, each other one what is below twice that of the one
  // before, the last what is longer: from 65,536 us on.
  static constexpr std::size_t kBuckets = 10;
  static constexpr std::uint32_t kFirstBelowUs = 256;

  void add(std::uint32_t us) {
    worst_us_ = std::max(worst_us_, us);
    sum_us_ += us;
    ++counts_[bucket_of(us)];
  }

  [[nodiscard]] std::uint32_t worst_us() const { return worst_us_; }
  [[nodiscard]] std::uint64_t sum_us() const { return sum_us_; }
  // Modulo 2^32.
  [[nodiscard]] const std::array<std::uint32_t, kBuckets>& counts() const { return counts_; }

 private:
  static constexpr std::size_t bucket_of(std::uint32_t us) {
    constexpr std::size_t kFirstBits = std::bit_width(kFirstBelowUs - 1);
    const auto bits = static_cast<std::size_t>(std::bit_width(us));
    return std::min(bits - std::min(bits, kFirstBits), kBuckets - 1);
  }

  std::uint32_t worst_us_ = 0;
  std::uint64_t sum_us_ = 0;
  std::array<std::uint32_t, kBuckets> counts_{};
};

}  // namespace iog::health
