// Controls cores 1 to 3 from core 0. HelperCores is the part of hal::Cores that all boards share.
// Each board adds count() and start(). ARM IHI 0048, GICD_SGIR, describes the software-generated
// interrupts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/cores.hpp"
#include "helper.hpp"
#include "machine.hpp"

namespace iog::board {

// Distributor contains the registers of the board's GIC. Clock is a hal::Clock.
template <typename Distributor, typename Clock>
class HelperCores {
 public:
  hal::CoreState state(std::size_t core) const {
    return helpers_[core - 1].state.load(std::memory_order_acquire);
  }

  // The helper compares the count before it sleeps, so a wake-up is never lost.
  void wake(std::size_t core) {
    helpers_[core - 1].wakes.fetch_add(1, std::memory_order_release);
    send(kInterruptWake, core);
  }

  bool stop(std::size_t core) {
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

  std::uint64_t now_us() { return clock_.now_us(); }
  void pause() { machine::yield(); }

  // Returns the reason why a helper ended, and the location at which it ended.
  std::string_view last_word(std::size_t core) const { return helpers_[core - 1].last_word.view(); }

 protected:
  HelperCores(Distributor& distributor, Clock& clock, Helpers& helpers)
      : distributor_(distributor), clock_(clock), helpers_(helpers) {}

  // Call this function before the board switches the core on.
  void prepare(std::size_t core, hal::CoreJob job) {
    Helper& helper = helpers_[core - 1];
    helper.job = job;
    helper.wakes.store(0, std::memory_order_relaxed);
    helper.state.store(hal::CoreState::kOff, std::memory_order_relaxed);
  }

  // Returns true if the core has started in time. Call this function after the board has switched
  // the core on. A core that starts later sleeps and is never woken.
  bool comes_up(std::size_t core) {
    const std::uint64_t begin_us = now_us();
    while (state(core) != hal::CoreState::kRunning) {
      if (now_us() - begin_us > kMaxStartUs) {
        return false;
      }
      pause();
    }
    return true;
  }

 private:
  // On hardware, a core starts in well under a millisecond. In QEMU on an idle PC, a core starts in
  // 6 to 14 ms.
  static constexpr std::uint32_t kMaxStartUs = 100'000;
  // A core takes an interrupt within microseconds, unless it waits for a bus that never answers.
  static constexpr std::uint32_t kMaxStopUs = 100'000;

  // All stores must be visible before the interrupt is sent, because stores to devices are not
  // ordered with stores to memory.
  void send(std::uint32_t interrupt, std::size_t core) {
    machine::barrier();
    distributor_.sgir.write(1u << (Distributor::kSgirTargetShift + core) | interrupt);
  }

  Distributor& distributor_;
  Clock& clock_;
  Helpers& helpers_;
};

}  // namespace iog::board
