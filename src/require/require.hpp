// Checks for programmer errors: conditions that can fail only if the program itself is wrong.
//
// Operating errors are reported with a status instead. A failed requirement stops the program and
// reports the source location. The board prints it as its last word and lets the watchdog reset the
// machine; the PC aborts. programmer_error() is defined by the program that links the core:
// board/imx6/, tools/ or tests/.
#pragma once

namespace iog {

[[noreturn]] void programmer_error(const char* file, int line);

constexpr void require(bool holds, const char* file = __builtin_FILE(),
                       int line = __builtin_LINE()) {
  if (!holds) [[unlikely]] {
    programmer_error(file, line);
  }
}

}  // namespace iog
