#include "helper.hpp"

#include "machine.hpp"
#include "registers/gic_of.hpp"

namespace iog::board {

constinit Helpers all_helpers{};

namespace {

// NOLINTNEXTLINE(bugprone-dynamic-static-initializers): its place is of the linker script
extern "C" GicCpuRegisters gic_cpu;

Helper& this_helper() { return all_helpers[machine::core_number() - 1]; }

// Until core 0 has woken this helper once more than `served` times. Asked with interrupts masked: a
// wake that comes in between is pending, and ends the sleep at once.
std::uint32_t sleep(const Helper& helper, std::uint32_t served) {
  for (;;) {
    machine::mask_interrupts();
    const std::uint32_t wakes = helper.wakes.load(std::memory_order_acquire);
    if (wakes == served) {
      machine::wait_for_interrupt();
    }
    machine::unmask_interrupts();
    if (wakes != served) {
      return wakes;
    }
  }
}

}  // namespace

void hear_nobody() { gic_cpu.ctlr.write(0); }

void end_helper(hal::CoreState state, const TextLine& last_word) {
  Helper& helper = this_helper();
  helper.last_word = last_word;
  helper.state.store(state, std::memory_order_release);
  // No interrupt ends this sleep: the GIC passes none on.
  hear_nobody();
  for (;;) {
    machine::wait_for_interrupt();
  }
}

void run_helper() {
  Helper& helper = this_helper();
  hear_core_0();
  helper.state.store(hal::CoreState::kRunning, std::memory_order_release);
  std::uint32_t served = 0;
  for (;;) {
    served = sleep(helper, served);
    helper.job.run(helper.job.context, machine::core_number());
  }
}

void stop_helper(std::uintptr_t pc) {
  end_helper(hal::CoreState::kStopped,
             TextLine().text("stopped pc=").hex(static_cast<std::uint32_t>(pc)));
}

}  // namespace iog::board
