// How many of a number of equal pipelines are taken in each cycle near the present.
#pragma once

#include <array>
#include <cstdint>

#include "cache.hpp"

namespace iog::a9_model {

class IssueSlots {
 public:
  explicit IssueSlots(std::uint32_t pipelines) : pipelines_(pipelines) {}

  // Takes one pipeline for some cycles in a row, as early as possible; says when that begins.
  Cycle take(Cycle from, std::uint32_t cycles = 1) {
    Cycle start = from;
    if (cycles == 1) {
      while (taken(start) >= pipelines_) {
        ++start;
      }
      ++at(start);
      return start;
    }
    for (std::uint32_t done = 0; done < cycles;) {
      if (taken(start + done) < pipelines_) {
        ++done;
      } else {
        start += done + 1;
        done = 0;
      }
    }
    for (std::uint32_t done = 0; done < cycles; ++done) {
      ++at(start + done);
    }
    return start;
  }

 private:
  // Far more than instructions in a window can be apart: a miss takes hundreds of cycles.
  static constexpr std::size_t kCycles = 1024;
  static constexpr unsigned kTakenBits = 3;

  // The pipelines taken in a cycle, below the number of that cycle.
  [[nodiscard]] std::uint64_t taken(Cycle cycle) const {
    const std::uint64_t entry = entries_[cycle % kCycles];
    return entry >> kTakenBits == cycle ? entry & ((1u << kTakenBits) - 1) : 0;
  }

  std::uint64_t& at(Cycle cycle) {
    std::uint64_t& entry = entries_[cycle % kCycles];
    if (entry >> kTakenBits != cycle) {
      entry = cycle << kTakenBits;
    }
    return entry;
  }

  std::uint32_t pipelines_;  // below 8
  std::array<std::uint64_t, kCycles> entries_{};
};

}  // namespace iog::a9_model
