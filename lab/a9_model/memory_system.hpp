// Both cache levels, the store buffer, the prefetcher and the memory channel of one core.
//
// A request has a time and gets a time; requests come in program order, their times nearly so. What
// is modelled and what is not is said in docs/a9_model.md.
#pragma once

#include <array>
#include <cstdint>

#include "cache.hpp"
#include "constants.hpp"
#include "tlb.hpp"

namespace iog::a9_model {

struct MemoryCounts {
  std::uint64_t instruction_refills = 0;
  std::uint64_t data_refills = 0;    // lines brought to L1 for loads, stores and preloads
  std::uint64_t data_evictions = 0;  // dirty lines that left L1
  std::uint64_t streamed_lines = 0;  // lines written past L1
  std::uint64_t l2_misses = 0;       // demands that L2 did not have; prefetched lines are not
  std::uint64_t ddr_reads = 0;       // lines
  std::uint64_t ddr_writes = 0;      // lines
};

class MemorySystem {
 public:
  explicit MemorySystem(const Constants& constants);

  // From here on, and nothing of it is in a cache.
  void set_uncached(std::uint32_t begin, std::uint32_t bytes) {
    uncached_begin_ = begin;
    uncached_bytes_ = bytes;
  }

  // A load reaches L1 at a time; when it can be answered like a hit of that time. What goes on with
  // the access before, of the same instruction, is of one burst with it, if uncached.
  Cycle load(std::uint32_t address, Cycle now, bool goes_on = false);
  // A preload: the line is wanted, nobody waits.
  void preload(std::uint32_t address, Cycle now) { static_cast<void>(line_for_data(address, now)); }
  // A store within one aligned doubleword is known to happen at a time; when the store buffer has
  // taken it.
  Cycle store(std::uint32_t address, std::uint32_t bytes, Cycle now);
  // When every store to uncached memory so far has been written: what a barrier waits for.
  [[nodiscard]] Cycle uncached_written() const { return uncached_written_; }
  // When the instruction at an address can be fetched.
  Cycle fetch(std::uint32_t address, Cycle now);

  // As hal::SharedCache, but code is restricted, too.
  void keep_l2(bool keep);

  [[nodiscard]] const MemoryCounts& counts() const { return counts_; }
  [[nodiscard]] const TlbCounts& tlb_counts() const { return tlb_counts_; }

 private:
  struct Slot {
    std::uint32_t doubleword = 0xffff'ffff;
    std::uint32_t hazard = 0xffff'ffff;  // its address in units of the hazard's size
    Cycle data = 0;                      // when the newest byte was stored
    Cycle done = 0;                      // when it has been written
  };

  [[nodiscard]] std::uint32_t hazard_of(std::uint32_t address) const {
    return address >> hazard_shift_;
  }
  [[nodiscard]] bool is_uncached(std::uint32_t address) const {
    return address - uncached_begin_ < uncached_bytes_;
  }
  Cycle read_uncached(std::uint32_t address, Cycle now, bool goes_on);
  Cycle write_uncached(Cycle now);
  Cache::Line* line_for_data(std::uint32_t address, Cycle now);
  struct Arrival {
    Cycle ready;
    bool from_memory;  // even if a prefetch had asked for it
  };
  Arrival read_line(LineAddress line, Cycle now, bool is_code);
  void write_to_l2(LineAddress line, Cycle now);
  Cycle read_memory(Cycle now);
  Cache::Line* allocate_in_l2(LineAddress line, Cycle now);
  void follow_streams(LineAddress line, bool from_memory, Cycle now);
  bool streams_writes(std::uint32_t address, std::uint32_t bytes);
  Cycle write_past_l1(LineAddress line, Cycle now);

  Constants constants_;
  std::uint32_t hazard_shift_;
  Cache code_;
  Cache data_;
  Cache l2_;
  MemoryCounts counts_;
  TlbCounts tlb_counts_;
  MainTlb main_tlb_;
  MicroTlb code_tlb_;
  MicroTlb data_tlb_;

  std::array<Cycle, 8> fill_free_{};
  Cycle l2_free_ = 0;   // the path between L1 and L2
  Cycle ddr_free_ = 0;  // the memory channel
  LineAddress fetched_line_ = 0xffff'ffff;

  std::array<LineAddress, 2> streams_{};  // the next line of each, the more recent first

  std::uint32_t uncached_begin_ = 0;
  std::uint32_t uncached_bytes_ = 0;
  std::array<Cycle, 4> uncached_free_{};  // when each read that may be under way has ended
  std::size_t reading_ = 0;               // the newest of them
  std::uint32_t burst_doubleword_ = 0;    // the newest of the burst that is read
  Cycle burst_ready_ = 0;                 // when it has come
  Cycle uncached_written_ = 0;

  std::array<Slot, 8> slots_{};
  std::size_t next_slot_ = 0;
  Cycle drain_ = 0;  // when the newest store began to be written

  LineAddress written_line_ = 0xffff'ffff;
  std::uint32_t written_bytes_ = 0;  // of that line, one bit each
  std::uint32_t whole_lines_ = 0;    // in a row before it
  LineAddress streamed_line_ = 0xffff'ffff;
};

}  // namespace iog::a9_model
