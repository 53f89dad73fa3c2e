// The clock of the perception grid. For each of the newest 64 frames, the clock stores the
// timestamp and the decay of evidence since then.
//
// Timestamps are rounded down from microseconds to milliseconds. Times are differences of rounded
// timestamps, so rounding errors do not accumulate. If a timestamp is older than the newest one,
// the newest one is used instead, so time never decreases.
//
// Each frame has a slot from 1 to 64. Slots are reused cyclically, so a stored slot number must be
// discarded within 63 frames. Each group stores the slot of the frame in which it was last aged,
// and the slot of the frame in which it last had evidence. A slot of 0 means that there has been no
// such frame.
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
  static constexpr std::uint32_t kEver = 0xFFFF'FFFF;  // time in ms since a slot without a frame

  // `tables` points to the tables of a car that defines its own constants, or is null if the
  // default constants are used. The tables must outlive the clock.
  constexpr explicit Clock(Discounting discounting = Discounting::kConservative,
                           Weighing weighing = Weighing::kByTime, const Tables* tables = nullptr)
      : discounting_(discounting),
        decays_(tables != nullptr ? &tables->decays : &kUsualDecays),
        gains_(tables != nullptr               ? &tables->gains
               : weighing == Weighing::kByTime ? &kGainsByTime
                                               : &kGainsOfScan) {}

  // Ends a frame. Call this function for every frame, even if the frame's evidence could not be
  // registered.
  void advance(std::uint64_t stamp_us);

  // Returns the slot of the newest frame, or kNever before the first frame.
  [[nodiscard]] std::uint8_t now() const { return now_; }

  // Returns the time from the frame in this slot to the newest frame. The result is at most kEver.
  [[nodiscard]] std::uint32_t ms_since(std::uint8_t slot) const;

  // Returns the number of frames from the frame in this slot to the newest frame. A frame must have
  // been assigned to this slot.
  [[nodiscard]] std::uint8_t frames_since(std::uint8_t slot) const {
    return static_cast<std::uint8_t>((now_ + kFrames - slot) % kFrames);
  }

  // Returns the ageing factors for a group. `slot` is the slot of the frame in which the group was
  // last aged. For kNever, all factors are 0.
  [[nodiscard]] const evidence::Fading& since(std::uint8_t slot) const { return left_[slot]; }

  // Returns the weights of the newest frame's evidence for a group. `slot` is the slot of the
  // previous frame with evidence for the group. The time between these two frames is clamped to
  // 1 ... 100 ms. For kNever, this time is 100 ms.
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
  const Decays* decays_;
  const GainsTable* gains_;
};

}  // namespace iog::ageing
