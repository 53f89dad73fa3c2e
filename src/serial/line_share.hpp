// Who sends next on a line that is too slow for all: the one that has had least, in proportion to
// its weight (start-time fair queueing: Goyal, Vin and Cheng, IEEE/ACM Transactions on Networking
// 5, 1997). Who has nothing to send for a while neither loses nor saves anything by it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace iog::serial {

template <std::size_t kParties>
class LineShare {
 public:
  // weights: parts of the line, each a divisor of kUnit.
  static constexpr std::uint32_t kUnit = 24;

  constexpr explicit LineShare(const std::array<std::uint32_t, kParties>& weights)
      : weights_{weights} {}

  // The next of those that have something to send; the first one of equals.
  [[nodiscard]] std::optional<std::size_t> next(const std::array<bool, kParties>& wants) {
    std::optional<std::size_t> chosen;
    for (std::size_t party = 0; party < kParties; ++party) {
      if (wants[party] && (!chosen || had_[party] < had_[*chosen])) {
        chosen = party;
      }
    }
    for (std::size_t party = 0; party < kParties && chosen; ++party) {
      had_[party] = wants[party] ? had_[party] : std::max(had_[party], had_[*chosen]);
    }
    return chosen;
  }

  // It has sent so many bytes.
  void charge(std::size_t party, std::size_t bytes) {
    had_[party] += static_cast<std::uint32_t>(bytes) * (kUnit / weights_[party]);
    const std::uint32_t least = *std::ranges::min_element(had_);
    for (std::uint32_t& had : had_) {
      had -= least;  // only differences count, and so they never overflow
    }
  }

 private:
  std::array<std::uint32_t, kParties> weights_;
  std::array<std::uint32_t, kParties> had_{};  // bytes, times kUnit / weight
};

}  // namespace iog::serial
