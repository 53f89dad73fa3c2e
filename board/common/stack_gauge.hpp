// Measures the maximum depth of a stack from the fill pattern that is still intact.
//
// Checking the whole pattern in every frame would take 65,536 loads and a quarter of the L2 cache.
// Each check therefore makes a bounded number of loads. A check examines the words just below the
// deepest used word, and one part of the remaining stack. Successive checks examine different
// parts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::board {

class StackGauge {
 public:
  // The fill pattern of unused words, which startup.S writes.
  static constexpr std::uint32_t kPaint = 0x5ac4'ed01;
  // A check ends after an intact gap of this size below the deepest used word. A function may leave
  // its whole stack frame unwritten while its callees write below the frame. However, no stack
  // frame is as large as the gap (check_image).
  static constexpr std::size_t kGapWords = 12 * 1024 / 4;
  // The number of words below the gap that each check covers.
  static constexpr std::size_t kSweepWords = 256;

  // Returns the number of bytes from the top to the deepest used word. Growth without a gap of 12
  // KiB is found immediately. Other growth is found within stack.size() / kSweepWords checks, which
  // take 10 s for 256 KiB at 25 checks per second. A check takes at most kGapWords + kSweepWords
  // loads, plus one load for each word of growth. Always pass the same stack.
  std::uint32_t used_bytes(std::span<const std::uint32_t> stack);

 private:
  // The number of used words, counted from the top of the stack.
  std::size_t used_words_ = 0;
  std::size_t next_swept_ = 0;  // counted from the lowest word
};

}  // namespace iog::board
