// Ends a run and writes one line with the reason to the console and to the boot record.
//
// It runs when everything else has ended, so it relies on little. It uses only registers and the
// uncached record, no driver objects, and each step runs at most once.
#pragma once

#include <string_view>

#include "hal/end_of_run.hpp"
#include "text_line.hpp"

namespace iog::board {

// Records and prints the line and waits for a reset of the chip.
[[noreturn]] void end_with_last_word(hal::End end, std::string_view text);

// On core 0, ends the run. On a helper, ends only this helper, and core 0 takes over its work.
[[noreturn]] void end_core(hal::End end, const TextLine& last_word);

// Implemented by each board. record_last_word() stores the last word. print_last_word() prints it,
// and starts the watchdog in case it was not running yet. wait_for_reset() requests a reset if the
// board can, and waits for it.
void record_last_word(hal::End end, std::string_view text);
void print_last_word(std::string_view text);
[[noreturn]] void wait_for_reset();

// The name of a cause in banners and last words.
std::string_view reason_of(hal::EndCause cause);
std::string_view words_of(hal::EndCause cause);

}  // namespace iog::board
