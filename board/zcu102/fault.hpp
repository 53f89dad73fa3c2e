// Reports a processor exception as the last word of the run or of a helper.
#pragma once

#include <cstdint>

#include "machine.hpp"
#include "text_line.hpp"

namespace iog::zcu102 {

// startup.S passes these numbers in x0 (docs/spec.md 3.7).
enum class FaultKind : std::uint64_t {
  kUndefinedInstruction = 1,
  kSupervisorCall = 2,
  kInstructionAbort = 3,
  kDataAbort = 4,
  kInterrupt = 5,
  kFastInterrupt = 6,
  kSystemError = 7,  // asynchronous: not caused by the current instruction
  kMisaligned = 8,   // program counter or stack pointer
};

// The layout of the frame that startup.S stores.
struct FaultFrame {
  FaultKind kind;
  std::uint64_t pc;    // the faulting instruction
  std::uint64_t spsr;  // processor state at the fault
  std::uint64_t lr;
  std::uint64_t sp;
  std::uint64_t esr;  // syndrome
  std::uint64_t far;  // the address of an abort
};

// Returns a text such as "data abort pc=... lr=... sp=... spsr=... esr=... far=...". If the address
// lies below a stack, the text ends with "(stack guard)". For a system error, pc is the instruction
// at which the core received the error.
TextLine describe(const FaultFrame& frame, bool in_stack_guard);

// startup.S calls this function on the stack for exceptions.
extern "C" [[noreturn]] void report_fault(const FaultFrame* frame);

}  // namespace iog::zcu102
