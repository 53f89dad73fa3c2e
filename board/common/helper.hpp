// Communication between core 0 and a helper, which is one of cores 1 to 3.
//
// core_start.S starts a helper, which then stays in run_helper(). It receives two interrupts from
// core 0: one wakes it, the other ends it at any point. Only helpers run with interrupts unmasked,
// and no handler shares data with the code that it interrupts.
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

// Each helper has its own cache lines.
struct alignas(64) Helper {
  // Set by core 0 while the helper is off, else by the helper.
  std::atomic<hal::CoreState> state{hal::CoreState::kOff};
  std::atomic<std::uint32_t> wakes{0};  // counted by core 0
  hal::CoreJob job{};                   // written by core 0 before the helper starts
  TextLine last_word;                   // written by the helper before it reports its end
};

using Helpers = std::array<Helper, hal::kMaxCores - 1>;

// The helpers on cores 1 to 3.
extern Helpers all_helpers;

// Ends the helper that calls it: stores its last word and sleeps forever. Its caches stay on, so
// its stores remain visible.
[[noreturn]] void end_helper(hal::CoreState state, const TextLine& last_word);

// Configures the interrupt controller to pass wake and stop to this core, or to pass nothing. Each
// board implements hear_core_0().
void hear_core_0();
void hear_nobody();

// Called by core_start.S on the helper's own stack, with MMU and caches on.
extern "C" [[noreturn]] void run_helper();

// Called by core_start.S after the stop interrupt. pc: the interrupted instruction.
extern "C" [[noreturn]] void stop_helper(std::uintptr_t pc);

}  // namespace iog::board
