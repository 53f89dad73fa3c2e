#include "stack_paint.hpp"

#include <cstddef>

namespace iog::lab {
namespace {

constexpr std::uint32_t kPaint = 0x5AC4ED01;
constexpr std::ptrdiff_t kWords = StackPaint::kBytes / sizeof(kPaint);

}  // namespace

// A leaf: what it needs of the stack lies above the sp that it reads.
void StackPaint::apply() {
  asm volatile("mov %0, sp" : "=r"(top_));
  for (Word* word = top_ - kWords; word != top_; ++word) {
    *word = kPaint;
  }
}

std::uint32_t StackPaint::used_bytes() const {
  Word* word = top_ - kWords;
  while (word != top_ && *word == kPaint) {
    ++word;
  }
  return static_cast<std::uint32_t>(top_ - word) * sizeof(kPaint);
}

}  // namespace iog::lab
