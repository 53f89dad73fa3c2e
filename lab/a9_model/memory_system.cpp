#include "memory_system.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace iog::a9_model {
namespace {

constexpr std::uint32_t kL1Bytes = 32 * 1024;        // i.MX 6Dual/6Quad data sheet, IMX6DQCEC
constexpr std::uint32_t kL1Ways = 4;                 // TRM 7.1.1
constexpr std::uint32_t kL2Bytes = 1024 * 1024;      // the same
constexpr std::uint32_t kL2Ways = 16;                // board/imx6/registers/pl310.hpp
constexpr std::uint32_t kOpenL2Ways = 2;             // likewise
constexpr std::uint32_t kMemoryBegin = 0x1000'0000;  // below it are registers, which no cache holds
constexpr std::uint32_t kWholeLine = 0xffff'ffff;

Cache::Replacement replacement(const Constants& constants) {
  return constants.random_replacement != 0 ? Cache::Replacement::kRandom
                                           : Cache::Replacement::kLeastRecentlyUsed;
}

}  // namespace

MemorySystem::MemorySystem(const Constants& constants)
    : constants_(constants),
      hazard_shift_(static_cast<std::uint32_t>(std::countr_zero(constants.store_hazard_bytes))),
      code_(kL1Bytes, kL1Ways, replacement(constants)),
      data_(kL1Bytes, kL1Ways, replacement(constants)),
      l2_(kL2Bytes, kL2Ways, replacement(constants)),
      code_tlb_(constants, main_tlb_, tlb_counts_),
      data_tlb_(constants, main_tlb_, tlb_counts_) {}

Cycle MemorySystem::load(std::uint32_t address, Cycle now, bool goes_on) {
  if (address < kMemoryBegin) {
    return now + constants_.device_extra;
  }
  now += data_tlb_.extra_cycles(address);
  if (is_uncached(address)) {
    return read_uncached(address, now, goes_on);
  }
  Cycle ready = now;
  if (const Cache::Line* const line = line_for_data(address, now); line->ready > ready) {
    ready = line->ready;
  }
  // A store on its way to the cache: its data is forwarded.
  const std::uint32_t hazard = hazard_of(address);
  for (std::uint32_t back = 1; back <= constants_.store_buffer; ++back) {
    const Slot& slot = slots_[(next_slot_ + slots_.size() - back) % slots_.size()];
    if (slot.hazard == hazard && slot.done > now) {
      const Cycle forwarded = slot.data + constants_.store_forward_cycles;
      return std::max(ready + constants_.load_to_use, forwarded) - constants_.load_to_use;
    }
  }
  return ready;
}

Cycle MemorySystem::store(std::uint32_t address, std::uint32_t bytes, Cycle now) {
  if (address < kMemoryBegin) {
    return now;
  }
  now += data_tlb_.extra_cycles(address);
  const bool streams = streams_writes(address, bytes);
  const std::uint32_t doubleword = address / 8;
  Slot& newest = slots_[(next_slot_ + slots_.size() - 1) % slots_.size()];
  if (newest.doubleword == doubleword && newest.done > now) {
    newest.data = now;
    newest.hazard = hazard_of(address);
    return now;
  }
  const Slot& oldest =
      slots_[(next_slot_ + slots_.size() - constants_.store_buffer) % slots_.size()];
  const Cycle taken = std::max(now, oldest.done);
  drain_ = std::max(taken, drain_ + 1);
  Cycle done = drain_ + 1;
  if (is_uncached(address)) {
    done = write_uncached(drain_);
  } else if (Cache::Line* line = data_.find(line_of(address)); line == nullptr && streams) {
    done = std::max(done, write_past_l1(line_of(address), drain_));
  } else {
    line = line != nullptr ? line : line_for_data(address, drain_);
    line->dirty = true;
    done = std::max(done, line->ready);
  }
  slots_[next_slot_] = {
      .doubleword = doubleword, .hazard = hazard_of(address), .data = now, .done = done};
  next_slot_ = (next_slot_ + 1) % slots_.size();
  return taken;
}

// A journey to the DDR, through the PL310. Whatever its size, it occupies the memory channel like a
// line; another one begins when one of those under way has ended.
Cycle MemorySystem::read_uncached(std::uint32_t address, Cycle now, bool goes_on) {
  const std::uint32_t doubleword = address / 8;
  if (goes_on && doubleword - burst_doubleword_ <= 1) {
    burst_ready_ += doubleword == burst_doubleword_ ? 0 : constants_.uncached_beat;
  } else {
    const auto* const first = uncached_free_.begin();
    reading_ = static_cast<std::size_t>(std::min_element(first, first + constants_.uncached_reads) -
                                        first);
    burst_ready_ = read_memory(std::max(now, uncached_free_[reading_]));
  }
  uncached_free_[reading_] = burst_ready_;
  burst_doubleword_ = doubleword;
  return burst_ready_;
}

Cycle MemorySystem::write_uncached(Cycle now) {
  ddr_free_ = std::max(ddr_free_, now) + constants_.uncached_write;
  uncached_written_ = ddr_free_;
  return ddr_free_;
}

Cycle MemorySystem::fetch(std::uint32_t address, Cycle now) {
  const LineAddress line = line_of(address);
  if (line == fetched_line_) {
    return now;
  }
  fetched_line_ = line;
  now += code_tlb_.extra_cycles(address);
  if (const Cache::Line* const found = code_.find(line); found != nullptr) {
    return std::max(now, found->ready);
  }
  ++counts_.instruction_refills;
  const Cycle ready = read_line(line, now, true).ready;
  code_.allocate(line).line->ready = ready;
  return ready;
}

// The line in L1, brought there if it was not. Two fill buffers serve loads, stores and preloads.
Cache::Line* MemorySystem::line_for_data(std::uint32_t address, Cycle now) {
  const LineAddress wanted = line_of(address);
  if (Cache::Line* const found = data_.find(wanted); found != nullptr) {
    return found;
  }
  ++counts_.data_refills;
  Cycle& buffer =
      *std::min_element(fill_free_.begin(), fill_free_.begin() + constants_.fill_buffers);
  const Cycle start = std::max(now, buffer);
  const auto [ready, from_memory] = read_line(wanted, start, false);
  // A buffer waits for memory, but not while L2 looks the line up.
  buffer = from_memory ? ready : ready - constants_.l2_extra + constants_.l2_fill_occupies;
  const Cache::Allocation place = data_.allocate(wanted);
  place.line->ready = ready;
  if (place.evicted.valid && place.evicted.dirty) {
    ++counts_.data_evictions;
    write_to_l2(place.evicted.address, start);
  }
  return place.line;
}

// A line goes from L2 to L1; when it is there. The channel between them passes one at a time.
MemorySystem::Arrival MemorySystem::read_line(LineAddress line, Cycle now, bool is_code) {
  const Cycle start = std::max(now, l2_free_);
  l2_free_ = start + constants_.l2_read_line;
  Cache::Line* found = l2_.find(line);
  const bool misses = found == nullptr;
  if (misses) {
    ++counts_.l2_misses;
    found = allocate_in_l2(line, start);
    found->ready = read_memory(start);
  }
  const Cycle from_l2 = start + constants_.l2_extra;
  const Cycle ready = std::max(from_l2, found->ready);
  const bool was_prefetched = std::exchange(found->prefetched, false);
  if (!is_code) {
    follow_streams(line, misses || was_prefetched, start);
  }
  return {.ready = ready, .from_memory = ready > from_l2};
}

// When a line that is asked for now can be in L1.
Cycle MemorySystem::read_memory(Cycle now) {
  ++counts_.ddr_reads;
  const Cycle start = std::max(now, ddr_free_);
  ddr_free_ = start + constants_.ddr_line;
  return start + constants_.l2_extra + constants_.ddr_latency;
}

void MemorySystem::keep_l2(bool keep) { l2_.open_ways(keep ? kOpenL2Ways : kL2Ways); }

Cache::Line* MemorySystem::allocate_in_l2(LineAddress line, Cycle now) {
  const Cache::Allocation place = l2_.allocate(line);
  if (place.evicted.valid && place.evicted.dirty) {
    ++counts_.ddr_writes;
    ddr_free_ = std::max(ddr_free_, now) + constants_.ddr_line;
  }
  return place.line;
}

void MemorySystem::write_to_l2(LineAddress line, Cycle now) {
  l2_free_ = std::max(l2_free_, now) + constants_.l2_write_line;
  Cache::Line* found = l2_.find(line);
  if (found == nullptr) {
    found = allocate_in_l2(line, now);
    found->ready = now;
  }
  found->dirty = true;
}

// Misses to consecutive lines make a stream; its next lines are brought to L2. Only what came from
// memory counts: lines that L2 had on its own account are not prefetched to L1 (7-cpu).
void MemorySystem::follow_streams(LineAddress line, bool from_memory, Cycle now) {
  if (!from_memory || constants_.prefetch_lines == 0) {
    return;
  }
  const bool second = streams_[1] == line;
  const bool follows = second || streams_[0] == line;
  if (second || !follows) {
    std::swap(streams_[0], streams_[1]);
  }
  streams_[0] = line + 1;
  if (!follows) {
    return;
  }
  for (LineAddress ahead = line + 1; ahead <= line + constants_.prefetch_lines; ++ahead) {
    if (l2_.find(ahead) == nullptr) {
      Cache::Line* const place = allocate_in_l2(ahead, now);
      place->ready = read_memory(now);
      place->prefetched = true;
    }
  }
}

// Does this store belong to a sequence that has written whole lines?
bool MemorySystem::streams_writes(std::uint32_t address, std::uint32_t bytes) {
  const LineAddress line = line_of(address);
  const std::uint32_t mask = ((1u << bytes) - 1) << (address % kLineBytes);
  if (line == written_line_) {
    written_bytes_ |= mask;
  } else {
    const bool continues = line == written_line_ + 1 && written_bytes_ == kWholeLine;
    whole_lines_ = continues ? whole_lines_ + 1 : 0;
    written_line_ = line;
    written_bytes_ = mask;
  }
  return whole_lines_ >= constants_.write_streaming_lines;
}

// A whole line for L2, doubleword by doubleword; the first one pays for the transfer. L2 takes it
// without reading memory, but what it replaces may have to be written first.
Cycle MemorySystem::write_past_l1(LineAddress line, Cycle now) {
  if (line == streamed_line_) {
    return now;
  }
  streamed_line_ = line;
  ++counts_.streamed_lines;
  const Cycle start = std::max(now, l2_free_);
  write_to_l2(line, now);
  const Cycle queue = Cycle{constants_.l2_evictions} * constants_.ddr_line;
  return std::max(start, ddr_free_ > queue ? ddr_free_ - queue : 0);
}

}  // namespace iog::a9_model
