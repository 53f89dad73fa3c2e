// One set-associative, write-back cache: which lines it holds, not what they contain.
#pragma once

#include <cstdint>
#include <vector>

namespace iog::a9_model {

using Cycle = std::uint64_t;

inline constexpr std::uint32_t kLineBytes = 32;

// An address without the bits within its line.
using LineAddress = std::uint32_t;
constexpr LineAddress line_of(std::uint32_t address) { return address / kLineBytes; }

class Cache {
 public:
  enum class Replacement : std::uint8_t { kLeastRecentlyUsed, kRandom };

  struct Line {
    LineAddress address = 0;
    bool valid = false;
    bool dirty = false;
    bool prefetched = false;  // brought by a prefetcher and not yet asked for
    Cycle ready = 0;          // when the bytes have arrived
    std::uint64_t used = 0;
  };

  // The number of sets, bytes / ways / kLineBytes, is a power of two.
  Cache(std::uint32_t bytes, std::uint32_t ways, Replacement replacement);
  Cache(const Cache&) = delete;
  Cache& operator=(const Cache&) = delete;
  ~Cache() = default;

  // The line, now the most recently used one of its set; null: not here. Valid until allocate().
  Line* find(LineAddress address) {
    if (recent_->address == address && recent_->valid) {
      recent_->used = ++clock_;
      return recent_;
    }
    Line* const set = &lines_[std::size_t{address & set_mask_} * ways_];
    for (std::uint32_t way = 0; way < ways_; ++way) {
      if (set[way].address == address && set[way].valid) {
        set[way].used = ++clock_;
        recent_ = &set[way];
        return recent_;
      }
    }
    return nullptr;
  }

  struct Allocation {
    Line* line;    // valid and clean
    Line evicted;  // what was there; valid says whether anything was
  };

  // From now on, allocate() uses only so many ways of each set. find() uses all.
  void open_ways(std::uint32_t ways) { open_ways_ = ways; }

  // Makes room for a line that find() does not find.
  Allocation allocate(LineAddress address);

 private:
  Line& victim(Line* set);

  std::uint32_t ways_;
  std::uint32_t open_ways_ = ways_;
  std::uint32_t set_mask_;
  Replacement replacement_;
  std::uint64_t clock_ = 0;
  std::uint32_t shift_register_ = 1;
  std::vector<Line> lines_;
  Line* recent_;  // found last; it may have become another line
};

}  // namespace iog::a9_model
