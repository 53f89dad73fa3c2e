// Controls cores 1 to 3 from core 0: the part of hal::Cores that all boards share. A board adds
// count() and start(). Software-generated interrupts: ARM IHI 0048, GICD_SGIR.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/cores.hpp"
#include "helper.hpp"
#include "machine.hpp"

namespace iog::board {

// Distributor: the registers of the board's GIC. Clock: hal::Clock.
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

  // The reason and the location at which a helper ended.
  std::string_view last_word(std::size_t core) const { return helpers_[core - 1].last_word.view(); }

 protected:
  HelperCores(Distributor& distributor, Clock& clock, Helpers& helpers)
      : distributor_(distributor), clock_(clock), helpers_(helpers) {}

  // Call it before the board switches the core on.
  void prepare(std::size_t core, hal::CoreJob job) {
    Helper& helper = helpers_[core - 1];
    helper.job = job;
    helper.wakes.store(0, std::memory_order_relaxed);
    helper.state.store(hal::CoreState::kOff, std::memory_order_relaxed);
  }

  // Call it after the board has switched the core on. Returns whether the core has started in time.
  // A core that starts later sleeps and is never woken.
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
  // A core starts in well under a millisecond, or in 6 to 14 ms in QEMU on an idle PC.
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
