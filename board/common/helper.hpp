// Communication between core 0 and a helper, which is one of cores 1 to 3.
//
// The code in core_start.S starts a helper, which then stays in run_helper(). Core 0 sends two
// interrupts to a helper. One interrupt wakes the helper, and the other ends the helper at any
// point. Only helpers run with interrupts unmasked. No handler shares data with the code that it
// interrupts.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "hal/cores.hpp"
#include "text_line.hpp"

namespace iog::board {

// The numbers of the software-generated interrupts. The code in core_start.S also uses the second
// number.
inline constexpr std::uint32_t kInterruptWake = 0;
inline constexpr std::uint32_t kInterruptStop = 1;

// Each helper has its own cache lines.
struct alignas(64) Helper {
  // Core 0 sets the state while the helper is off. Otherwise, the helper sets the state.
  std::atomic<hal::CoreState> state{hal::CoreState::kOff};
  std::atomic<std::uint32_t> wakes{0};  // counted by core 0
  hal::CoreJob job{};                   // written by core 0 before the helper starts
  TextLine last_word;                   // written by the helper before it reports its end
};

using Helpers = std::array<Helper, hal::kMaxCores - 1>;

// The helpers on cores 1 to 3.
extern Helpers all_helpers;

// Ends the calling helper. The function stores the helper's last word and sleeps forever. The
// caches of the helper stay on, so its stores remain visible.
[[noreturn]] void end_helper(hal::CoreState state, const TextLine& last_word);

// hear_core_0() configures the interrupt controller to pass the wake and stop interrupts to this
// core. `hear_nobody()` configures the interrupt controller to pass no interrupts. Each board
// implements hear_core_0().
void hear_core_0();
void hear_nobody();

// The code in core_start.S calls this function on the helper's own stack, with MMU and caches on.
extern "C" [[noreturn]] void run_helper();

// The code in core_start.S calls this function after the stop interrupt. `pc` is the interrupted
// instruction.
extern "C" [[noreturn]] void stop_helper(std::uintptr_t pc);

}  // namespace iog::board
