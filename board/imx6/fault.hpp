// The end of a run: one line that says what happened, on the console and in the boot record.
#pragma once

#include <cstdint>
#include <string_view>

#include "hal/end_of_run.hpp"
#include "memory/mmu.hpp"
#include "text_line.hpp"

namespace iog::imx6 {

// The numbers are those startup.S puts in r0.
enum class FaultKind : std::uint32_t {
  kUndefinedInstruction = 1,
  kSupervisorCall = 2,
  kPrefetchAbort = 3,
  kDataAbort = 4,
  kInterrupt = 5,
  kFastInterrupt = 6,  // the watchdog's: the loop hangs (gic.hpp)
};

// As startup.S pushes it.
struct FaultFrame {
  FaultKind kind;
  std::uint32_t pc;    // the instruction at fault
  std::uint32_t spsr;  // the state it ran in
  std::uint32_t lr;    // Supervisor mode's
  std::uint32_t sp;
};

// Status and address registers of the MMU: DFSR and DFAR after a data abort, IFSR and IFAR after a
// prefetch abort. Zero for all other kinds.
struct FaultStatus {
  std::uint32_t status = 0;
  std::uint32_t address = 0;
};

// "data abort pc=... lr=... sp=... spsr=... fsr=... far=..." and, if the address lies below a
// stack,
// "(stack guard)". An "asynchronous abort" has no address, and pc is where the core was when it
// heard of it.
TextLine describe(const FaultFrame& frame, const FaultStatus& status, const mmu::MemoryMap& map);

// Prints and records the line and waits for the watchdog to reset the chip.
[[noreturn]] void end_with_last_word(hal::End end, std::string_view text);

// Ends the run if this is core 0, else this helper.
[[noreturn]] void end_core(hal::End end, const TextLine& last_word);

// Called by startup.S on the stack of the exception's mode.
extern "C" [[noreturn]] void report_fault(const FaultFrame* frame);

}  // namespace iog::imx6
