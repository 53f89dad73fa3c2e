// The rate at which bytes are handed to the serial port: a token bucket, one token a byte.
//
// The port has a ring, so it takes far more than the link has sent, and what waits in the ring is
// old before it leaves. Therefore bytes are handed over at the link's own rate, at most a short
// burst ahead of it. (An emulated link has no rate but this one.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace iog::serial {

class TokenBucket {
 public:
  // The bucket is full after this long. So the loop may take as long for a pass, or for the passes
  // that compose the next message, before the link runs dry.
  static constexpr std::uint32_t kBurstUs = 40'000;

  // What that is in bytes.
  [[nodiscard]] static constexpr std::uint32_t burst_bytes(std::uint32_t bytes_per_second) {
    return static_cast<std::uint32_t>(std::uint64_t{bytes_per_second} * kBurstUs / kToken);
  }

  // Time has passed. now_us must not go back. bytes_per_second < 10^5.
  void refill(std::uint64_t now_us, std::uint32_t bytes_per_second) {
    const auto elapsed_us = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(now_us - now_us_, kBurstUs));  // after this the bucket is full
    now_us_ = now_us;
    const std::uint32_t most = kBurstUs * bytes_per_second;
    level_ += std::min(elapsed_us * bytes_per_second, most - level_);
  }

  // Tokens in the bucket: bytes that may be handed over now.
  [[nodiscard]] std::size_t tokens() const { return level_ / kToken; }

  // At most tokens().
  void spend(std::size_t tokens) { level_ -= static_cast<std::uint32_t>(tokens) * kToken; }

 private:
  static constexpr std::uint32_t kToken = 1'000'000;  // of the level, which is in bytes times us

  std::uint64_t now_us_ = 0;
  std::uint32_t level_ = 0;
};

}  // namespace iog::serial
