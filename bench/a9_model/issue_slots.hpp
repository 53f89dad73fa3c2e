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
    for (std::uint32_t done = 0; done < cycles;) {
      if (taken(start + done) < pipelines_) {
        ++done;
      } else {
        start += done + 1;
        done = 0;
      }
    }
    for (std::uint32_t done = 0; done < cycles; ++done) {
      ++at(start + done).taken;
    }
    return start;
  }

 private:
  // Far more than instructions in a window can be apart: a miss takes hundreds of cycles.
  static constexpr std::size_t kCycles = 4096;

  struct Entry {
    Cycle cycle = 0;
    std::uint32_t taken = 0;
  };

  [[nodiscard]] std::uint32_t taken(Cycle cycle) const {
    const Entry& entry = entries_[cycle % kCycles];
    return entry.cycle == cycle ? entry.taken : 0;
  }

  Entry& at(Cycle cycle) {
    Entry& entry = entries_[cycle % kCycles];
    if (entry.cycle != cycle) {
      entry = {.cycle = cycle, .taken = 0};
    }
    return entry;
  }

  std::uint32_t pipelines_;
  std::array<Entry, kCycles> entries_{};
};

}  // namespace iog::a9_model
