// Ends a run and writes one line with the reason to the console and to the boot record.
//
// This code runs when all other code has ended, so it uses only registers and the uncached record,
// but no driver objects. Each step runs at most once.
#pragma once

#include <string_view>

#include "hal/end_of_run.hpp"
#include "text_line.hpp"

namespace iog::board {

// Records and prints the line, and waits for a reset of the chip.
[[noreturn]] void end_with_last_word(hal::End end, std::string_view text);

// On core 0, this function ends the run. On a helper, it ends only this helper, and core 0 takes
// over the helper's work.
[[noreturn]] void end_core(hal::End end, const TextLine& last_word);

// Each board implements these functions. `record_last_word()` stores the last word.
// `print_last_word()` prints the last word, and starts the watchdog in case the watchdog was not
// running yet. `wait_for_reset()` requests a reset if the board supports requests, and waits for
// the reset.
void record_last_word(hal::End end, std::string_view text);
void print_last_word(std::string_view text);
[[noreturn]] void wait_for_reset();

// These functions return the name of a cause in banners and last words.
std::string_view reason_of(hal::EndCause cause);
std::string_view words_of(hal::EndCause cause);

}  // namespace iog::board
