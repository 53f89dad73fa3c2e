#include "fault.hpp"

namespace iog::zcu102 {
namespace {

std::string_view name(FaultKind kind) {
  switch (kind) {
    case FaultKind::kUndefinedInstruction:
      return "undefined instruction";
    case FaultKind::kSupervisorCall:
      return "supervisor call";
    case FaultKind::kInstructionAbort:
      return "instruction abort";
    case FaultKind::kDataAbort:
      return "data abort";
    case FaultKind::kInterrupt:
      return "interrupt taken";
    case FaultKind::kFastInterrupt:
      return "fast interrupt taken";
    case FaultKind::kSystemError:
      return "system error";
    case FaultKind::kMisaligned:
      return "misaligned program counter or stack";
  }
  return "unknown exception";
}

// All memory is below 4 GiB; only what went astray needs more digits.
void put(TextLine& line, std::string_view what, std::uint64_t value) {
  line.text(what);
  if (value >> 32 != 0) {
    line.hex(static_cast<std::uint32_t>(value >> 32));
  }
  line.hex(static_cast<std::uint32_t>(value));
}

}  // namespace

TextLine describe(const FaultFrame& frame, bool in_stack_guard) {
  TextLine line;
  line.text(name(frame.kind));
  put(line, " pc=", frame.pc);
  put(line, " lr=", frame.lr);
  put(line, " sp=", frame.sp);
  put(line, " spsr=", frame.spsr);
  put(line, " esr=", frame.esr);
  if (frame.kind == FaultKind::kDataAbort || frame.kind == FaultKind::kInstructionAbort) {
    put(line, " far=", frame.far);
    line.text(in_stack_guard ? " (stack guard)" : "");
  }
  return line;
}

}  // namespace iog::zcu102
