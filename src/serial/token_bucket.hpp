// Uses a token bucket to limit the rate at which bytes are passed to the serial port. One token
// represents one byte.
//
// The port's ring buffer holds far more bytes than the link can send in time, and bytes become
// stale while they wait in it. Bytes are therefore passed to the port at no more than the link's
// data rate, apart from short bursts. On an emulated link, the token bucket is the only rate limit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace iog::serial {

class TokenBucket {
 public:
  // The time in which an empty bucket fills. The link stays busy as long as neither a loop
  // iteration nor the composition of a message takes longer than kBurstUs.
  static constexpr std::uint32_t kBurstUs = 40'000;

  // Returns the size of the burst in bytes.
  [[nodiscard]] static constexpr std::uint32_t burst_bytes(std::uint32_t bytes_per_second) {
    return static_cast<std::uint32_t>(std::uint64_t{bytes_per_second} * kBurstUs / kToken);
  }

  // Adds the tokens for the time since the last call. `now_us` must not decrease. Requires
  // bytes_per_second < 10^5.
  void refill(std::uint64_t now_us, std::uint32_t bytes_per_second) {
    const auto elapsed_us = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(now_us - now_us_, kBurstUs));  // more time also fills the bucket
    now_us_ = now_us;
    const std::uint32_t most = kBurstUs * bytes_per_second;
    level_ += std::min(elapsed_us * bytes_per_second, most - level_);
  }

  // Returns the number of tokens, which is how many bytes may be passed to the port now.
  [[nodiscard]] std::size_t tokens() const { return level_ / kToken; }

  // Requires tokens <= this->tokens().
  void spend(std::size_t tokens) { level_ -= static_cast<std::uint32_t>(tokens) * kToken; }

 private:
  static constexpr std::uint32_t kToken = 1'000'000;  // level_ of one byte, in byte microseconds

  std::uint64_t now_us_ = 0;
  std::uint32_t level_ = 0;
};

}  // namespace iog::serial
