// How deep a call goes: paints the stack below the caller and looks later how far the paint is
// gone.
#pragma once

#include <cstdint>

namespace iog::lab {

class StackPaint {
 public:
  // Paints kBytes below the caller's frame. Nothing may interrupt, or it would be painted over.
  [[gnu::noinline]] void apply();

  // Bytes below that point that have been written since; kBytes: all of them, or more.
  [[nodiscard]] std::uint32_t used_bytes() const;

  static constexpr std::uint32_t kBytes = 64 * 1024;

 private:
  // Words that belong to no object of the language: only the processor knows where its stack is.
  using Word = volatile std::uint32_t;

  Word* top_ = nullptr;
};

}  // namespace iog::lab
