// Limits the bytes passed to the serial port with a token bucket. One token stands for one byte.
//
// The port's ring buffer holds far more bytes than the link can send in time, and bytes become
// stale while they wait in it. Bytes are therefore passed on at the link's data rate, with at most
// a short burst ahead of it. For an emulated link, this is the only rate limit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace iog::serial {

class TokenBucket {
 public:
  // The time in which an empty bucket fills up. The link does not run idle if one loop iteration,
  // or the iterations that compose the next message, take no longer than this.
  static constexpr std::uint32_t kBurstUs = 40'000;

  // The size of this burst in bytes.
  [[nodiscard]] static constexpr std::uint32_t burst_bytes(std::uint32_t bytes_per_second) {
    return static_cast<std::uint32_t>(std::uint64_t{bytes_per_second} * kBurstUs / kToken);
  }

  // Advances the time. now_us must not decrease. bytes_per_second < 10^5.
  void refill(std::uint64_t now_us, std::uint32_t bytes_per_second) {
    const auto elapsed_us = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(now_us - now_us_, kBurstUs));  // more time also fills the bucket
    now_us_ = now_us;
    const std::uint32_t most = kBurstUs * bytes_per_second;
    level_ += std::min(elapsed_us * bytes_per_second, most - level_);
  }

  // Tokens in the bucket: the number of bytes that may be passed on now.
  [[nodiscard]] std::size_t tokens() const { return level_ / kToken; }

  // Requires tokens <= this->tokens().
  void spend(std::size_t tokens) { level_ -= static_cast<std::uint32_t>(tokens) * kToken; }

 private:
  static constexpr std::uint32_t kToken = 1'000'000;  // level_ of one byte, in byte microseconds

  std::uint64_t now_us_ = 0;
  std::uint32_t level_ = 0;
};

}  // namespace iog::serial
