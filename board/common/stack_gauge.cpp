#include "stack_gauge.hpp"

#include "machine.hpp"

namespace iog::board {

std::uint32_t StackGauge::used_bytes(std::span<const std::uint32_t> stack) {
  const auto is_used = [stack](std::size_t word) { return machine::load(stack[word]) != kPaint; };
  std::size_t deepest = stack.size() - used_words_;
  // From the lowest word up, because a stack that is nearly full has to show soonest.
  for (std::size_t swept = 0; swept < kSweepWords && next_swept_ < deepest; ++swept) {
    if (is_used(next_swept_)) {
      deepest = next_swept_;
    }
    ++next_swept_;
  }
  if (next_swept_ >= deepest) {
    next_swept_ = 0;
  }
  // Downwards from the deepest word, over gaps.
  std::size_t gap = 0;
  for (std::size_t word = deepest; word > 0 && gap < kGapWords; --word) {
    gap = is_used(word - 1) ? 0 : gap + 1;
    deepest = gap == 0 ? word - 1 : deepest;
  }
  used_words_ = stack.size() - deepest;
  return static_cast<std::uint32_t>(used_words_ * sizeof(std::uint32_t));
}

}  // namespace iog::board
