// Cores (hal/cores.hpp) that do nothing but be what a test says.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/cores.hpp"

namespace iog::tests {

struct ScriptedCores {
  std::size_t machine_has = 1;
  std::array<bool, hal::kMaxCores> comes_up{true, true, true, true};
  std::array<hal::CoreState, hal::kMaxCores> states{};
  std::array<bool, hal::kMaxCores> comes{};  // when it is woken
  std::array<hal::CoreJob, hal::kMaxCores> jobs{};
  std::uint64_t time_us = 0;

  [[nodiscard]] std::size_t count() const { return machine_has; }
  bool start(std::size_t core, hal::CoreJob job) {
    jobs[core] = job;
    states[core] = comes_up[core] ? hal::CoreState::kRunning : hal::CoreState::kOff;
    return comes_up[core];
  }
  [[nodiscard]] hal::CoreState state(std::size_t core) const { return states[core]; }
  // It comes at once, and is gone when this returns.
  void wake(std::size_t core) {
    if (comes[core] && states[core] == hal::CoreState::kRunning) {
      jobs[core].run(jobs[core].context, core);
    }
  }
  bool stop(std::size_t core) {
    states[core] = hal::CoreState::kStopped;
    return true;
  }
  [[nodiscard]] std::string_view last_word(std::size_t core) const {
    return states[core] == hal::CoreState::kFaulted ? "data abort" : "";
  }
  [[nodiscard]] std::uint64_t now_us() const { return time_us; }
  void pause() { ++time_us; }
};

static_assert(hal::Cores<ScriptedCores>);

}  // namespace iog::tests
