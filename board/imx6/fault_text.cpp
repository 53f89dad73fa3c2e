// The part of a fault report that needs no machine.
#include "fault.hpp"

namespace iog::imx6 {
namespace {

std::string_view name(FaultKind kind) {
  switch (kind) {
    case FaultKind::kUndefinedInstruction:
      return "undefined instruction";
    case FaultKind::kSupervisorCall:
      return "supervisor call";
    case FaultKind::kPrefetchAbort:
      return "prefetch abort";
    case FaultKind::kDataAbort:
      return "data abort";
    case FaultKind::kInterrupt:
      return "interrupt taken";
    case FaultKind::kFastInterrupt:
      return "fast interrupt taken";
  }
  return "unknown exception";
}

}  // namespace

TextLine describe(const FaultFrame& frame, const FaultStatus& status, const mmu::MemoryMap& map) {
  TextLine line;
  line.text(name(frame.kind));
  line.text(" pc=").hex(frame.pc).text(" lr=").hex(frame.lr).text(" sp=").hex(frame.sp);
  line.text(" spsr=").hex(frame.spsr);
  const bool aborted =
      frame.kind == FaultKind::kDataAbort || frame.kind == FaultKind::kPrefetchAbort;
  if (aborted) {
    line.text(" fsr=").hex(status.status).text(" far=").hex(status.address);
    if (mmu::in_stack_guard(map, status.address)) {
      line.text(" (stack guard)");
    }
  }
  return line;
}

}  // namespace iog::imx6
