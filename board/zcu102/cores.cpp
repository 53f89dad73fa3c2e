#include "cores.hpp"

#include "psci.hpp"

namespace iog::zcu102 {

static_assert(hal::Cores<Cores>);

namespace {

// startup.S.
extern "C" void Helper_Start();  // NOLINT(readability-identifier-naming): as its neighbours

// As on the i.MX6: an emulator on a busy PC needs most of it.
constexpr std::uint32_t kMaxStartUs = 100'000;
constexpr std::uint32_t kMaxStopUs = 100'000;

}  // namespace

// L2CTLR_EL1 (Cortex-A53 TRM, ARM DDI 0500, 4.3.67) has the number of cores less one.
std::size_t Cores::count() const {
  std::uint64_t l2ctlr = 0;
  __asm__("mrs %0, s3_1_c11_c0_2" : "=r"(l2ctlr));
  return (l2ctlr >> 24 & 3) + 1;
}

bool Cores::start(std::size_t core, hal::CoreJob job) {
  Helper& helper = helpers_[core - 1];
  helper.job = job;
  helper.wakes.store(0, std::memory_order_relaxed);
  helper.state.store(hal::CoreState::kOff, std::memory_order_relaxed);
  machine::barrier();
  // A helper knows its number from MPIDR and needs no context.
  const auto entry = reinterpret_cast<std::uintptr_t>(&Helper_Start);
  if (machine::call_psci(psci::kCpuOn, core, entry) != psci::kSuccess) {
    return false;
  }
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

// What was stored is visible before the interrupt is.
void Cores::send(std::uint32_t interrupt, std::size_t core) {
  machine::barrier();
  distributor_.sgir.write(1u << (GicDistributorRegisters::kSgirTargetShift + core) | interrupt);
}

}  // namespace iog::zcu102
