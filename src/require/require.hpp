// Checks for programming errors. A condition passed to require() is false only if the program
// itself is wrong.
//
// Run-time errors are reported through a status instead. If a requirement fails, the program
// reports the source location and stops. On the board, core 0 records the location as the last word
// (docs/glossary.md) and prints it, and the watchdog then resets the machine. A failed requirement
// on a helper stops only this helper. On the PC, the program aborts. Each program that links the
// core defines programmer_error() in board/common/, tools/ or tests/.
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
