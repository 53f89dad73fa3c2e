// SRC by IMX6DQRM, chapter "System Reset Controller (SRC)": a core is held back until its enable
// bit in SRC_SCR is set, and begins anew when its reset bit is, which clears itself; then the boot
// ROM jumps to the address in its register PERSISTENT_ENTRY.
#include "cores.hpp"

namespace iog::imx6 {

static_assert(hal::Cores<Cores>);

std::size_t Cores::count() const {
  return (scu_.configuration.read() & ScuRegisters::kConfigurationCores) + 1;
}

bool Cores::start(std::size_t core, hal::CoreJob job) {
  prepare(core, job);
  const std::uint32_t enable = 1u << (SrcRegisters::kScrCore1EnableShift + core - 1);
  const std::uint32_t reset = 1u << (SrcRegisters::kScrCore1ResetShift + core - 1);
  // Another core's reset that still shows would be asked for again.
  const std::uint32_t others = src_.scr.read() & ~(SrcRegisters::kScrCoreResets | enable);
  // A loader may have used the core, so it is stopped first.
  src_.scr.write(others);
  src_.entry[core].address.write(entry_);
  // A helper knows its number from MPIDR and needs no argument.
  src_.entry[core].argument.write(0);
  machine::barrier();
  // With its reset: enabling alone need not begin it anew.
  src_.scr.write(others | enable | reset);
  return comes_up(core);
}

}  // namespace iog::imx6
