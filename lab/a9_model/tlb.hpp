// Address translation: micro TLBs of the instruction and the data side before one main TLB.
// Pages are mapped one to one, so only the cost is modelled.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "constants.hpp"

namespace iog::a9_model {

struct TlbCounts {
  std::uint64_t micro_misses = 0;
  std::uint64_t walks = 0;
};

// The main TLB: 2 x 64 entries, one of the sizes of TRM 6.1 and that of 7-cpu; least recently used.
class MainTlb {
 public:
  bool find_or_insert(std::uint32_t page);

 private:
  static constexpr std::uint32_t kSets = 64;
  std::array<std::array<std::uint32_t, 2>, kSets> pages_{};  // page + 1, the more recent first
};

class MicroTlb {
 public:
  MicroTlb(const Constants& constants, MainTlb& main, TlbCounts& counts);

  // Cycles that translation adds to an access.
  std::uint32_t extra_cycles(std::uint32_t address) {
    const std::uint32_t page = address >> page_shift_;
    return page == recent_ ? 0 : look_up(page);
  }

 private:
  std::uint32_t look_up(std::uint32_t page);

  MainTlb& main_;
  TlbCounts& counts_;
  std::uint32_t page_shift_;
  std::uint32_t main_extra_;
  std::uint32_t walk_extra_;
  std::uint32_t recent_;  // the page of the access before
  std::uint64_t clock_ = 0;
  struct Entry {
    std::uint32_t page;
    std::uint64_t used;
  };
  std::vector<Entry> entries_;
};

}  // namespace iog::a9_model
