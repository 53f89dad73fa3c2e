// What core 0 and a helper, one of the cores 1 to 3, say to each other.
//
// A helper is started by core_start.S and lives in run_helper(). Two interrupts reach it, both sent
// by core 0: one wakes it, the other ends it wherever it is. It is the only code of this firmware
// that runs with interrupts unmasked, and no handler shares anything with what it interrupts.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "hal/cores.hpp"
#include "text_line.hpp"

namespace iog::board {

// Software-generated interrupts. core_start.S knows the second number.
inline constexpr std::uint32_t kInterruptWake = 0;
inline constexpr std::uint32_t kInterruptStop = 1;

// On cache lines of its own.
struct alignas(64) Helper {
  // Set by core 0 while the helper is off, else by the helper.
  std::atomic<hal::CoreState> state{hal::CoreState::kOff};
  std::atomic<std::uint32_t> wakes{0};  // counted by core 0
  hal::CoreJob job{};                   // written by core 0 before the helper starts
  TextLine last_word;                   // written by the helper before it says that it has ended
};

using Helpers = std::array<Helper, hal::kMaxCores - 1>;

// Of cores 1 to 3.
extern Helpers all_helpers;

// Ends the helper that calls it: leaves its last word and sleeps for ever. Its caches stay on, so
// that what it has stored stays visible.
[[noreturn]] void end_helper(hal::CoreState state, const TextLine& last_word);

// Configures the interrupt controller to pass wake and stop to this core, or to pass nothing. Each
// board implements hear_core_0().
void hear_core_0();
void hear_nobody();

// Called by core_start.S on the helper's own stack, with MMU and caches on.
extern "C" [[noreturn]] void run_helper();

// Called by core_start.S when the stop interrupt has come; pc: of what it interrupted.
extern "C" [[noreturn]] void stop_helper(std::uintptr_t pc);

}  // namespace iog::board
