// The working time of each core, in ticks modulo 2^32. Each core's time has its own cache line. A
// core writes only its own time but may read the times of other cores.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "hal/cores.hpp"
#include "work/round.hpp"

namespace iog::work {

class CoreTimes {
 public:
  void add(std::size_t core, std::uint32_t ticks) { count_up(cores_[core].ticks, ticks); }
  [[nodiscard]] std::uint32_t ticks(std::size_t core) const {
    return cores_[core].ticks.load(std::memory_order_relaxed);
  }

 private:
  struct alignas(64) Core {
    std::atomic<std::uint32_t> ticks{0};
  };
  std::array<Core, hal::kMaxCores> cores_{};
};

}  // namespace iog::work
