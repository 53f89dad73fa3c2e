// Programmer errors: what cannot happen unless the program itself is wrong.
//
// They are never mixed with operating errors, which have a status. A broken requirement stops the
// program with its place; the board prints it as a last word and lets the watchdog reset, the PC
// aborts. programmer_error() is defined by the program that links the core: board/imx6/ or tools/
// or tests/.
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
