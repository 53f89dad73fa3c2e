#include "ageing/clock.hpp"

#include <algorithm>

namespace iog::ageing {

void Clock::advance(std::uint64_t stamp_us) {
  const std::uint64_t ms = std::max(stamp_us / 1000, stamps_ms_[now_]);
  now_ = static_cast<std::uint8_t>(now_ % kFrames + 1);
  frames_ = std::max(frames_, now_);
  stamps_ms_[now_] = ms;
  for (std::uint8_t slot = 1; slot <= frames_; ++slot) {
    left_[slot] = left_after(ms_since(slot), discounting_, *decays_);
  }
}

std::uint32_t Clock::ms_since(std::uint8_t slot) const {
  if (slot == kNever || slot > frames_) {
    return kEver;
  }
  const std::uint64_t ms = stamps_ms_[now_] - stamps_ms_[slot];
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(ms, kEver));
}

const evidence::Gains& Clock::gains(std::uint8_t slot) const {
  return gains_after(ms_since(slot), *gains_);
}

}  // namespace iog::ageing
