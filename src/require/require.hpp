// Checks for programming errors. A programming error is a condition that fails only if the program
// itself is wrong.
//
// Run-time errors are reported through a status instead. A failed requirement stops the program and
// reports the source location. On the board, the program prints the location as its last word, and
// the watchdog resets the machine. On the PC, the program aborts. Each program that links the core
// defines programmer_error() in board/imx6/, tools/ or tests/.
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
