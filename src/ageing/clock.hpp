// The clock of the perception grid: the timestamps of the newest 64 frames, and the decay of
// evidence since each frame.
//
// Each timestamp is first rounded down from microseconds to milliseconds. Times are differences of
// rounded timestamps, so rounding errors do not accumulate. Time never goes back: an older
// timestamp is replaced by the newest timestamp.
//
// Each frame has a slot, 1 ... 64. Slots are reused cyclically, so a stored slot number must be
// discarded within 63 frames. Slot 0 means no frame: a group with slot 0 was never aged or never
// had evidence.
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

  // `tables` are those of a car with its own constants and must outlive the clock. They are null
  // for the default constants.
  constexpr explicit Clock(Discounting discounting = Discounting::kConservative,
                           Weighing weighing = Weighing::kByTime, const Tables* tables = nullptr)
      : discounting_(discounting),
        decays_(tables != nullptr ? &tables->decays : &kUsualDecays),
        gains_(tables != nullptr               ? &tables->gains
               : weighing == Weighing::kByTime ? &kGainsByTime
                                               : &kGainsOfScan) {}

  // Ends a frame. Call it for every frame, even if the frame's evidence could not be registered.
  void advance(std::uint64_t stamp_us);

  // The slot of the newest frame, or kNever before the first frame.
  [[nodiscard]] std::uint8_t now() const { return now_; }

  // The time from the frame of this slot to the newest frame, at most kEver.
  [[nodiscard]] std::uint32_t ms_since(std::uint8_t slot) const;

  // The number of frames from the frame of this slot to the newest frame. The slot must have a
  // frame.
  [[nodiscard]] std::uint8_t frames_since(std::uint8_t slot) const {
    return static_cast<std::uint8_t>((now_ + kFrames - slot) % kFrames);
  }

  // The ageing factors for a group that was last aged in this slot. For kNever, all factors are 0.
  [[nodiscard]] const evidence::Fading& since(std::uint8_t slot) const { return left_[slot]; }

  // The weights of evidence in the newest frame, for a group that last had evidence in this slot.
  // The time since then is clamped to 1 ... 100 ms. For kNever, it is 100 ms.
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
