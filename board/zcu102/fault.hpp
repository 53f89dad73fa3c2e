// An exception of the processor, as the last word of the run or of a helper.
#pragma once

#include <cstdint>

#include "machine.hpp"
#include "text_line.hpp"

namespace iog::zcu102 {

// The numbers are those startup.S puts in x0 (docs/spec.md 3.7).
enum class FaultKind : std::uint64_t {
  kUndefinedInstruction = 1,
  kSupervisorCall = 2,
  kInstructionAbort = 3,
  kDataAbort = 4,
  kInterrupt = 5,
  kFastInterrupt = 6,
  kSystemError = 7,  // asynchronous: nobody waited for it when it came
  kMisaligned = 8,   // program counter or stack pointer
};

// As startup.S stores it.
struct FaultFrame {
  FaultKind kind;
  std::uint64_t pc;    // the instruction at fault
  std::uint64_t spsr;  // the state it ran in
  std::uint64_t lr;
  std::uint64_t sp;
  std::uint64_t esr;  // syndrome
  std::uint64_t far;  // the address that an abort is about
};

// "data abort pc=... lr=... sp=... spsr=... esr=... far=..." and, if the address lies below a
// stack,
// "(stack guard)". Of a system error pc is where the core was when it heard of it.
TextLine describe(const FaultFrame& frame, bool in_stack_guard);

// Called by startup.S on the stack for exceptions.
extern "C" [[noreturn]] void report_fault(const FaultFrame* frame);

}  // namespace iog::zcu102
