#include "cores.hpp"

#include "psci.hpp"

namespace iog::zcu102 {

static_assert(hal::Cores<Cores>);

namespace {

// startup.S.
extern "C" void Helper_Start();  // NOLINT(readability-identifier-naming): as its neighbours

}  // namespace

// L2CTLR_EL1 (Cortex-A53 TRM, ARM DDI 0500, 4.3.67) has the number of cores less one.
std::size_t Cores::count() const {
  std::uint64_t l2ctlr = 0;
  __asm__("mrs %0, s3_1_c11_c0_2" : "=r"(l2ctlr));
  return (l2ctlr >> 24 & 3) + 1;
}

bool Cores::start(std::size_t core, hal::CoreJob job) {
  prepare(core, job);
  machine::barrier();
  // A helper knows its number from MPIDR and needs no context.
  const auto entry = reinterpret_cast<std::uintptr_t>(&Helper_Start);
  if (machine::call_psci(psci::kCpuOn, core, entry) != psci::kSuccess) {
    return false;
  }
  return comes_up(core);
}

}  // namespace iog::zcu102
