// Reports a processor exception as the last word of the run or of a helper.
#pragma once

#include <cstdint>

#include "machine.hpp"
#include "memory/mmu.hpp"
#include "text_line.hpp"

namespace iog::imx6 {

// startup.S passes these numbers in r0.
enum class FaultKind : std::uint32_t {
  kUndefinedInstruction = 1,
  kSupervisorCall = 2,
  kPrefetchAbort = 3,
  kDataAbort = 4,
  kInterrupt = 5,
  kFastInterrupt = 6,  // from the watchdog: the loop hangs (gic.hpp)
};

// The layout of the frame that startup.S pushes.
struct FaultFrame {
  FaultKind kind;
  std::uint32_t pc;    // the faulting instruction
  std::uint32_t spsr;  // processor state at the fault
  std::uint32_t lr;    // of Supervisor mode
  std::uint32_t sp;
};

// The status and address registers of the MMU: DFSR and DFAR after a data abort, IFSR and IFAR
// after a prefetch abort. For all other kinds, the values are zero.
struct FaultStatus {
  std::uint32_t status = 0;
  std::uint32_t address = 0;
};

// Returns a text such as "data abort pc=... lr=... sp=... spsr=... fsr=... far=...". If the address
// lies below a stack, the text ends with "(stack guard)". An "asynchronous abort" has no address.
// The pc of an asynchronous abort is the instruction at which the core received the abort.
TextLine describe(const FaultFrame& frame, const FaultStatus& status, const mmu::MemoryMap& map);

// startup.S calls this function on the stack of the exception's mode.
extern "C" [[noreturn]] void report_fault(const FaultFrame* frame);

}  // namespace iog::imx6
