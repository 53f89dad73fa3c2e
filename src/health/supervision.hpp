// Detects checkpoints that report too late. The class implements the alive supervision of a
// watchdog manager (AUTOSAR SWS WdgM), with one time window per checkpoint.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace iog::health {

struct Checkpoint {
  std::string_view name;
  std::uint64_t window_us = 0;  // the longest allowed time between two reports
};

// Supervises kCount checkpoints, at most 32. Each checkpoint is identified by a number.
template <std::size_t kCount>
class Supervision {
  static_assert(kCount <= 32);

 public:
  using Checkpoints = std::array<Checkpoint, kCount>;

  // Starts as if all checkpoints had just reported.
  Supervision(const Checkpoints& checkpoints, std::uint64_t now_us) : checkpoints_(checkpoints) {
    seen_us_.fill(now_us);
  }

  void lives(std::size_t checkpoint, std::uint64_t now_us) { seen_us_[checkpoint] = now_us; }

  // Returns a mask in which bit i is set if checkpoint i has not reported for longer than its
  // window.
  [[nodiscard]] std::uint32_t late(std::uint64_t now_us) const {
    std::uint32_t late = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      late |= now_us - seen_us_[i] > checkpoints_[i].window_us ? 1U << i : 0U;
    }
    return late;
  }

  // Returns the name of the late checkpoint with the lowest number. `late` must not be 0.
  [[nodiscard]] std::string_view name_of_first(std::uint32_t late) const {
    return checkpoints_[static_cast<std::size_t>(std::countr_zero(late))].name;
  }

 private:
  Checkpoints checkpoints_;
  std::array<std::uint64_t, kCount> seen_us_{};
};

}  // namespace iog::health
