// Limits the bytes passed to the serial port with a token bucket, one token per byte.
//
// The port has a ring that takes far more bytes than the link can send, and bytes that wait in it
// become stale. Bytes are therefore passed on at the link's own rate, at most a short burst ahead
// of it. (This is the only rate limit of an emulated link.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace iog::serial {

class TokenBucket {
 public:
  // The time that fills the bucket. The loop may take this long for one pass, or for the passes
  // that compose the next message, before the link runs idle.
  static constexpr std::uint32_t kBurstUs = 40'000;

  // The same burst in bytes.
  [[nodiscard]] static constexpr std::uint32_t burst_bytes(std::uint32_t bytes_per_second) {
    return static_cast<std::uint32_t>(std::uint64_t{bytes_per_second} * kBurstUs / kToken);
  }

  // Advances the time. now_us must not decrease. bytes_per_second < 10^5.
  void refill(std::uint64_t now_us, std::uint32_t bytes_per_second) {
    const auto elapsed_us = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(now_us - now_us_, kBurstUs));  // more time fills the bucket, too
    now_us_ = now_us;
    const std::uint32_t most = kBurstUs * bytes_per_second;
    level_ += std::min(elapsed_us * bytes_per_second, most - level_);
  }

  // Tokens in the bucket: the number of bytes that may be passed on now.
  [[nodiscard]] std::size_t tokens() const { return level_ / kToken; }

  // Requires tokens <= this->tokens().
  void spend(std::size_t tokens) { level_ -= static_cast<std::uint32_t>(tokens) * kToken; }

 private:
  static constexpr std::uint32_t kToken = 1'000'000;  // level_, in bytes times us, of one byte

  std::uint64_t now_us_ = 0;
  std::uint32_t level_ = 0;
};

}  // namespace iog::serial
