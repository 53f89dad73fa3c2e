#include "helper.hpp"

#include "peripherals.hpp"

namespace iog::imx6 {

constinit Helpers all_helpers{};

namespace {

Helper& this_helper() { return all_helpers[core_number() - 1]; }

void mask_interrupts() { __asm__ volatile("cpsid i" ::: "memory"); }
void unmask_interrupts() { __asm__ volatile("cpsie i\n\tisb" ::: "memory"); }

// Until core 0 has woken this helper once more than `served` times. Asked with interrupts masked: a
// wake that comes in between is pending, and ends the sleep at once.
std::uint32_t sleep(const Helper& helper, std::uint32_t served) {
  for (;;) {
    mask_interrupts();
    const std::uint32_t wakes = helper.wakes.load(std::memory_order_acquire);
    if (wakes == served) {
      machine::wait_for_interrupt();
    }
    unmask_interrupts();
    if (wakes != served) {
      return wakes;
    }
  }
}

}  // namespace

std::size_t core_number() {
  std::uint32_t mpidr = 0;
  __asm__("mrc p15, 0, %0, c0, c0, 5" : "=r"(mpidr));
  return mpidr & 3;
}

void end_helper(hal::CoreState state, const TextLine& last_word) {
  Helper& helper = this_helper();
  helper.last_word = last_word;
  helper.state.store(state, std::memory_order_release);
  // No interrupt ends this sleep: the GIC passes none on.
  gic_cpu.ctlr.write(0);
  for (;;) {
    machine::wait_for_interrupt();
  }
}

// The registers of the GIC's CPU interface are each core's own, and so is the group of each private
// interrupt. This puts wake and stop into group 0, whatever the loader has left.
void run_helper() {
  Helper& helper = this_helper();
  gic_distributor.igroupr[0].write(0);
  gic_cpu.pmr.write(GicCpuRegisters::kPmrAll);
  gic_cpu.ctlr.write(GicCpuRegisters::kCtlrEnable);
  helper.state.store(hal::CoreState::kRunning, std::memory_order_release);
  std::uint32_t served = 0;
  for (;;) {
    served = sleep(helper, served);
    helper.job.run(helper.job.context, core_number());
  }
}

void stop_helper(std::uint32_t pc) {
  end_helper(hal::CoreState::kStopped, TextLine().text("stopped pc=").hex(pc));
}

}  // namespace iog::imx6
