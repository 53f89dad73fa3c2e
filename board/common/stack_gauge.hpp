// How deep a stack has ever been, read off the paint that is still there.
//
// To look at all of the paint in every frame would be 65,536 loads and a quarter of the L2 cache.
// So a look takes a bounded number of them: just below the deepest word, and a part of the rest, in
// turns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::board {

class StackGauge {
 public:
  // What an untouched word looks like; startup.S writes it.
  static constexpr std::uint32_t kPaint = 0x5ac4'ed01;
  // A look ends behind so much paint below the deepest word. A function may leave all of its frame
  // unwritten, and what it calls writes below it; no frame is as large (check_image).
  static constexpr std::size_t kGapWords = 12 * 1024 / 4;
  // Of what lies deeper still, so much is looked at each time.
  static constexpr std::size_t kSweepWords = 256;

  // Bytes from the top down to the deepest word that is used. Growth without a gap of 12 KiB shows
  // at once; any other within stack.size() / kSweepWords looks, which is 10 s for 256 KiB at 25
  // looks a second. Takes at most kGapWords + kSweepWords loads, and one for each word that the
  // stack has grown by. Every look is at the same stack.
  std::uint32_t used_bytes(std::span<const std::uint32_t> stack);

 private:
  // Of the words of the stack, counted from the top.
  std::size_t used_words_ = 0;
  std::size_t next_swept_ = 0;  // counted from the lowest word
};

}  // namespace iog::board
