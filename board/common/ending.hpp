// The end of a run: one line that says why, on the console and in the boot record.
//
// It runs when everything else has ended, so it trusts little: no driver object, only registers and
// the uncached record, and each step can be reached once.
#pragma once

#include <string_view>

#include "hal/end_of_run.hpp"
#include "text_line.hpp"

namespace iog::board {

// Records and prints the line and waits for a reset of the chip.
[[noreturn]] void end_with_last_word(hal::End end, std::string_view text);

// Ends the run if this is core 0, else this helper, while core 0 does its work.
[[noreturn]] void end_core(hal::End end, const TextLine& last_word);

// Of each board: puts a last word into the record; prints it, and starts the watchdog in case the
// end came before it ran; lets the chip be reset.
void record_last_word(hal::End end, std::string_view text);
void print_last_word(std::string_view text);
[[noreturn]] void wait_for_reset();

// How a banner and a last word name an end.
std::string_view reason_of(hal::EndCause cause);
std::string_view words_of(hal::EndCause cause);

}  // namespace iog::board
