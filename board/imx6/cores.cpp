// SRC by IMX6DQRM, chapter "System Reset Controller (SRC)": a core is held back until its enable
// bit in SRC_SCR is set, and begins anew when its reset bit is, which clears itself; then the boot
// ROM jumps to the address in its register PERSISTENT_ENTRY. Software-generated interrupts by ARM
// IHI 0048, GICD_SGIR.
#include "cores.hpp"

namespace iog::imx6 {

static_assert(hal::Cores<Cores>);

namespace {

// The boot ROM and core_start.S take well below a millisecond, QEMU 6 to 14 ms on an idle PC.
constexpr std::uint32_t kMaxStartUs = 100'000;
// A core takes an interrupt within microseconds, unless it waits for a bus that never answers.
constexpr std::uint32_t kMaxStopUs = 100'000;

}  // namespace

std::size_t Cores::count() const {
  return (scu_.configuration.read() & ScuRegisters::kConfigurationCores) + 1;
}

bool Cores::start(std::size_t core, hal::CoreJob job) {
  Helper& helper = helpers_[core - 1];
  helper.job = job;
  helper.wakes.store(0, std::memory_order_relaxed);
  helper.state.store(hal::CoreState::kOff, std::memory_order_relaxed);
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
  const std::uint64_t begin_us = now_us();
  while (state(core) != hal::CoreState::kRunning) {
    if (now_us() - begin_us > kMaxStartUs) {
      return false;  // if it comes up later, it sleeps and is never woken
    }
    pause();
  }
  return true;
}

hal::CoreState Cores::state(std::size_t core) const {
  return helpers_[core - 1].state.load(std::memory_order_acquire);
}

// The helper compares the count before it sleeps, so a wake is never lost, whatever it does now.
void Cores::wake(std::size_t core) {
  helpers_[core - 1].wakes.fetch_add(1, std::memory_order_release);
  send(kInterruptWake, core);
}

bool Cores::stop(std::size_t core) {
  send(kInterruptStop, core);
  const std::uint64_t begin_us = now_us();
  while (state(core) == hal::CoreState::kRunning) {
    if (now_us() - begin_us > kMaxStopUs) {
      return false;
    }
    pause();
  }
  return true;
}

std::string_view Cores::last_word(std::size_t core) const {
  return helpers_[core - 1].last_word.view();
}

// What was stored is visible before the interrupt is: a device takes a store when it likes.
void Cores::send(std::uint32_t interrupt, std::size_t core) {
  machine::barrier();
  distributor_.sgir.write(1u << (GicDistributorRegisters::kSgirTargetShift + core) | interrupt);
}

}  // namespace iog::imx6
