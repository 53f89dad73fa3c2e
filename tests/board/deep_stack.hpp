// A recursion that meets the guard page below any stack.
#pragma once

#include <array>
#include <cstdint>

namespace iog::tests {

// Not, in a way that the compiler cannot know.
inline bool never() {
  bool answer = false;
  __asm__ volatile("" : "+r"(answer));
  return answer;
}

// 1 KiB a step, and each step needs the one below it.
inline std::uint32_t overflow(std::uint32_t depth) {
  std::array<volatile std::uint32_t, 256> frame{};
  frame[depth % frame.size()] = depth;
  return never() ? 0 : overflow(depth + 1) + frame[depth % frame.size()];
}

}  // namespace iog::tests
