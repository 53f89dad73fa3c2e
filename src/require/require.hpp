// Checks for programming errors. If a condition passed to require() is false, the program itself is
// wrong.
//
// Run-time errors are reported through a status instead. If a requirement fails, the program
// reports the source location and stops. On the board, core 0 records the location as the last word
// (docs/glossary.md) and prints it. The watchdog then resets the machine. If a requirement fails on
// a helper, only this helper stops. On the PC, the program aborts. Each program that links the core
// defines programmer_error() in board/common/, tools/ or tests/.
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
