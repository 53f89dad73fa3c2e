// What the model counts, for the whole run and for each region of interest.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace iog::a9_model {

struct Counters {
  std::uint64_t instructions = 0;
  std::uint64_t cycles = 0;
  std::uint64_t l1i_refills = 0;
  std::uint64_t l1d_refills = 0;
  std::uint64_t l1d_evictions = 0;
  std::uint64_t streamed_lines = 0;
  std::uint64_t l2_misses = 0;
  std::uint64_t ddr_reads = 0;
  std::uint64_t ddr_writes = 0;
  std::uint64_t branches = 0;
  std::uint64_t mispredicts = 0;
  std::uint64_t tlb_misses = 0;
  std::uint64_t walks = 0;
  std::uint64_t unknown = 0;  // instructions that were not decoded
};

struct Counter {
  std::string_view name;
  std::uint64_t Counters::*member;
};

inline constexpr std::array kCounters{
    Counter{"instructions", &Counters::instructions},
    Counter{"cycles", &Counters::cycles},
    Counter{"l1i_refills", &Counters::l1i_refills},
    Counter{"l1d_refills", &Counters::l1d_refills},
    Counter{"l1d_evictions", &Counters::l1d_evictions},
    Counter{"streamed_lines", &Counters::streamed_lines},
    Counter{"l2_misses", &Counters::l2_misses},
    Counter{"ddr_reads", &Counters::ddr_reads},
    Counter{"ddr_writes", &Counters::ddr_writes},
    Counter{"branches", &Counters::branches},
    Counter{"mispredicts", &Counters::mispredicts},
    Counter{"tlb_misses", &Counters::tlb_misses},
    Counter{"walks", &Counters::walks},
    Counter{"unknown", &Counters::unknown},
};

// sum += to - from
inline void add_difference(Counters& sum, const Counters& from, const Counters& to) {
  for (const Counter& counter : kCounters) {
    sum.*counter.member += to.*counter.member - from.*counter.member;
  }
}

}  // namespace iog::a9_model
