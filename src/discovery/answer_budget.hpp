// Uses a token bucket to limit the rate of answers. Each answer costs one token, so a flood of
// requests does not cause a flood of answers.
#pragma once

#include <algorithm>
#include <cstdint>

namespace iog::discovery {

class AnswerBudget {
 public:
  static constexpr std::uint32_t kBurst = 8;
  static constexpr std::uint32_t kPerTokenUs = 100'000;

  // Takes a token. Returns false if no token is left. `now_us` must not decrease.
  [[nodiscard]] constexpr bool take(std::uint64_t now_us) {
    // The elapsed time is capped at the time it takes to fill the bucket, so a 32-bit division is
    // sufficient.
    const auto elapsed_us = static_cast<std::uint32_t>(
        std::min<std::uint64_t>(now_us - since_us_, std::uint64_t{kBurst} * kPerTokenUs));
    const std::uint32_t gained = elapsed_us / kPerTokenUs;
    tokens_ = std::min(kBurst, tokens_ + gained);
    since_us_ = tokens_ == kBurst ? now_us : since_us_ + std::uint64_t{gained} * kPerTokenUs;
    if (tokens_ == 0) {
      return false;
    }
    --tokens_;
    return true;
  }

 private:
  std::uint32_t tokens_ = kBurst;
  std::uint64_t since_us_ = 0;
};

}  // namespace iog::discovery
