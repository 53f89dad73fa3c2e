// Programmer errors: conditions that can only fail if the program itself is wrong.
//
// They are separate from operating errors, which have a status. A failed requirement stops the
// program with its source location. The board prints it as a last word and lets the watchdog reset;
// the PC aborts. The program that links the core defines programmer_error(): board/imx6/, tools/ or
// tests/.
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
