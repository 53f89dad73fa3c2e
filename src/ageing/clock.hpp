// Time as the grid sees it: the stamps of the newest 64 frames, and what has happened to evidence
// since each of them.
//
// A stamp's microseconds are floored to milliseconds before anything else, and times are
// differences of floors, so that no rounding adds up. Time does not go back: an older stamp counts
// as the newest.
//
// A frame has a slot, 1 ... 64; slots are used in turn. Whoever keeps a slot must let go of it
// within 63 frames. Slot 0 is no frame: a group of zeros was never aged and never had evidence.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ageing/discounting.hpp"
#include "ageing/gains.hpp"
#include "evidence/factors.hpp"

namespace iog::ageing {

class Clock {
 public:
  static constexpr std::size_t kFrames = 64;
  static constexpr std::uint8_t kNever = 0;
  static constexpr std::uint32_t kEver = 0xFFFF'FFFF;  // ms since a slot that has no frame

  constexpr explicit Clock(Discounting discounting = Discounting::kConservative,
                           Weighing weighing = Weighing::kByTime)
      : discounting_(discounting), weighing_(weighing) {}

  // A frame ends now: every one, whether its evidence could be placed or not.
  void advance(std::uint64_t stamp_us);

  // The slot of the newest frame; kNever before the first.
  [[nodiscard]] std::uint8_t now() const { return now_; }

  // From the frame of this slot to the newest one, at most kEver.
  [[nodiscard]] std::uint32_t ms_since(std::uint8_t slot) const;

  // The same in frames, for a slot that has one.
  [[nodiscard]] std::uint8_t frames_since(std::uint8_t slot) const {
    return static_cast<std::uint8_t>((now_ + kFrames - slot) % kFrames);
  }

  // What is left of a group that was last aged in this slot; nothing of kNever.
  [[nodiscard]] const evidence::Fading& since(std::uint8_t slot) const { return left_[slot]; }

  // The weights of evidence in the newest frame, for a group that last had some in this slot: of
  // 1 ... 100 ms, and of 100 ms for kNever.
  [[nodiscard]] const evidence::Gains& gains(std::uint8_t slot) const;

 private:
  static constexpr std::array<evidence::Fading, kFrames + 1> nothing_left() {
    std::array<evidence::Fading, kFrames + 1> left{};
    left.fill(evidence::kForgotten);
    return left;
  }

  std::array<std::uint64_t, kFrames + 1> stamps_ms_{};  // by slot
  std::array<evidence::Fading, kFrames + 1> left_ = nothing_left();
  std::uint8_t now_ = kNever;
  std::uint8_t frames_ = 0;  // slots in use
  Discounting discounting_;
  Weighing weighing_;
};

}  // namespace iog::ageing
