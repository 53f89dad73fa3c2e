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
      return "hung";
  }
  return "unknown exception";
}

// The fault status of the short descriptors: DFSR bits 10 and 3 to 0 (ARM ARM, table B3-23).
bool is_asynchronous(const FaultFrame& frame, const FaultStatus& status) {
  constexpr std::uint32_t kExternal = 0x406;
  constexpr std::uint32_t kParity = 0x408;
  const std::uint32_t cause = status.status & 0x40f;
  return frame.kind == FaultKind::kDataAbort && (cause == kExternal || cause == kParity);
}

}  // namespace

TextLine describe(const FaultFrame& frame, const FaultStatus& status, const mmu::MemoryMap& map) {
  TextLine line;
  const bool unawaited = is_asynchronous(frame, status);
  line.text(unawaited ? "asynchronous abort" : name(frame.kind));
  line.text(" pc=").hex(frame.pc).text(" lr=").hex(frame.lr).text(" sp=").hex(frame.sp);
  line.text(" spsr=").hex(frame.spsr);
  const bool aborted =
      frame.kind == FaultKind::kDataAbort || frame.kind == FaultKind::kPrefetchAbort;
  if (aborted) {
    line.text(" fsr=").hex(status.status);
  }
  if (aborted && !unawaited) {
    line.text(" far=").hex(status.address);
    if (mmu::in_stack_guard(map, status.address)) {
      line.text(" (stack guard)");
    }
  }
  return line;
}

}  // namespace iog::imx6
