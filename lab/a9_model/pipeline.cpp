#include "pipeline.hpp"

#include <algorithm>
#include <bit>

namespace iog::a9_model {
namespace {

bool is_store(Kind kind) {
  return kind == Kind::kStore || kind == Kind::kStoreNarrow || kind == Kind::kStoreMultiple ||
         kind == Kind::kVectorStore;
}
bool is_narrow(Kind kind) { return kind == Kind::kLoadNarrow || kind == Kind::kStoreNarrow; }

// Aligned doublewords that accesses in ascending order touch: what the port passes in one cycle
// each (TRM B.3).
std::uint32_t doublewords(std::span<const MemoryAccess> accesses) {
  std::uint32_t count = 0;
  std::uint32_t last = 0xffff'ffff;
  for (const MemoryAccess& access : accesses) {
    const std::uint32_t first = access.address / 8;
    const std::uint32_t end = (access.address + access.bytes - 1) / 8;
    count += (first != last ? 1u : 0u) + (end - first);
    last = end;
  }
  return std::max(count, 1u);
}

}  // namespace

Pipeline::Pipeline(const Constants& constants)
    : constants_(constants),
      memory_(constants),
      predictor_(constants.history_bits),
      alu_slots_(constants.alus),
      port_slots_(1) {}

void Pipeline::execute(const ProgramInstruction& what, std::span<const MemoryAccess> accesses,
                       std::uint32_t next) {
  const Cycle dispatched = dispatch(what);
  Cycle done = dispatched;
  switch (what.timing.unit) {
    case Unit::kNone:
      break;
    case Unit::kAlu:
    case Unit::kMultiplier:
    case Unit::kBranch:
      done = execute_alu(what, dispatched);
      break;
    case Unit::kVector:
      done = execute_vector(what, dispatched);
      break;
    case Unit::kMemory:
      done = execute_memory(what, accesses, dispatched);
      break;
    case Unit::kSerial:
      done = std::max({dispatched, retired_, vector_free_, memory_.uncached_written()}) + 1;
      dispatched_ = done;
      write(what.instruction.writes, done, 0);
      break;
  }
  retired_ = std::max(retired_, done);
  retire_times_[instructions_ % kRing] = retired_;
  ++instructions_;
  unknown_ += what.instruction.kind == Kind::kUnknown ? 1 : 0;
  if (what.instruction.flow != Flow::kNone || next != what.address + 4) {
    steer_fetch(what, next, done);
  }
}

// Fetch brings aligned pairs, some instructions ahead of dispatch; dispatch is limited by its width
// and by the window.
Cycle Pipeline::dispatch(const ProgramInstruction& what) {
  const std::uint64_t index = instructions_;
  fetched_ += (what.address & 4) == 0 ? 1 : 0;
  if (index >= constants_.fetch_queue) {
    fetched_ = std::max(fetched_, dispatch_times_[(index - constants_.fetch_queue) % kRing]);
  }
  fetched_ = memory_.fetch(what.address, fetched_);
  Cycle when = std::max(fetched_, dispatched_);
  if (index >= constants_.window) {
    when = std::max(when, retire_times_[(index - constants_.window) % kRing]);
  }
  if (what.timing.unit == Unit::kVector && vector_count_ >= constants_.vector_queue) {
    when = std::max(when, vector_times_[(vector_count_ - constants_.vector_queue) % kRing]);
  }
  if (when == dispatched_ && dispatched_now_ == constants_.dispatch_width) {
    ++when;
  }
  dispatched_now_ = when == dispatched_ ? dispatched_now_ + 1 : 1;
  dispatched_ = when;
  dispatch_times_[index % kRing] = when;
  return when;
}

Cycle Pipeline::core_ready(CoreSet reads, bool fast_forward) const {
  Cycle ready = 0;
  for (CoreSet left = reads; left != 0; left &= left - 1) {
    const auto index = static_cast<unsigned>(std::countr_zero(left));
    Cycle of_this = ready_[index];
    if (fast_forward && (forwarded_ & core_bit(index)) != 0) {
      of_this -= constants_.load_to_use - constants_.load_to_alu;
    }
    ready = std::max(ready, of_this);
  }
  return ready;
}

// When an instruction can begin that reads these in one of its stages, the first being 1.
Cycle Pipeline::vector_ready(VectorSet reads, std::uint32_t read_stage) const {
  Cycle ready = 0;
  for (VectorSet left = reads; left != 0; left &= left - 1) {
    ready = std::max(ready, vector_ready_[static_cast<unsigned>(std::countr_zero(left))]);
  }
  return ready >= read_stage ? ready - (read_stage - 1) : 0;
}

// The second of two results comes later by some cycles.
void Pipeline::write(CoreSet results, Cycle ready, Cycle later_by) {
  forwarded_ &= ~results;
  for (CoreSet left = results; left != 0; left &= left - 1) {
    ready_[static_cast<unsigned>(std::countr_zero(left))] = ready;
    ready += later_by;
  }
}

void Pipeline::write_vector(VectorSet results, Cycle ready) {
  for (VectorSet left = results; left != 0; left &= left - 1) {
    vector_ready_[static_cast<unsigned>(std::countr_zero(left))] = ready;
  }
}

Cycle Pipeline::execute_alu(const ProgramInstruction& what, Cycle dispatched) {
  const Timing& timing = what.timing;
  Cycle start =
      std::max(dispatched, core_ready(what.instruction.reads, what.instruction.fast_forward));
  if (timing.unit == Unit::kAlu) {
    start = alu_slots_.take(start, timing.occupies);
  } else if (timing.unit == Unit::kMultiplier) {
    start = alu_slots_.take(std::max(start, multiplier_free_));
    multiplier_free_ = start + timing.occupies;
  }
  const Cycle done = start + timing.latency;
  write(what.instruction.writes, done, timing.second_result);
  return done;
}

// The window does not hold a vector instruction: once it is in the queue it will be executed. What
// it gives to the core is waited for.
Cycle Pipeline::execute_vector(const ProgramInstruction& what, Cycle dispatched) {
  const Timing& timing = what.timing;
  const Instruction& instruction = what.instruction;
  if (constants_.shares_load_port != 0) {
    dispatched = port_slots_.take(dispatched);
  }
  const Cycle core = core_ready(instruction.reads, false);
  const Cycle vector = vector_ready(instruction.vector_reads, timing.read_stage);
  const Cycle start = std::max({dispatched + constants_.vector_skew, vector_free_, core, vector});
  vector_free_ = start + timing.occupies;
  vector_times_[vector_count_ % kRing] = start;
  ++vector_count_;
  write(instruction.writes, start + timing.latency, 0);
  write_vector(instruction.vector_writes, start + timing.latency);
  return instruction.kind == Kind::kVectorToCore ? start + timing.latency : dispatched + 1;
}

// Addresses are made in program order; the data of a store may come later.
Cycle Pipeline::execute_memory(const ProgramInstruction& what,
                               std::span<const MemoryAccess> accesses, Cycle dispatched) {
  const Instruction& instruction = what.instruction;
  const bool stores = is_store(instruction.kind);
  const CoreSet condition = instruction.conditional ? core_bit(kFlags) : CoreSet{0};
  Cycle start = std::max(
      {dispatched, address_order_, core_ready(instruction.address_reads | condition, false)});
  if (stores && constants_.stores_wait_for_data != 0) {
    start = std::max(start, data_ready(instruction));
  }
  const Cycle issued = reserve_port(what, accesses, start);
  address_order_ = issued;
  write(instruction.base_writes, issued + 1, 0);
  if (accesses.empty()) {  // its condition failed
    return issued + 1;
  }
  if (instruction.kind == Kind::kPreload) {
    memory_.preload(accesses.front().address, issued);
    return issued + 1;
  }
  return stores ? store(what, accesses, issued) : load(what, accesses, issued);
}

// The port passes an aligned doubleword a cycle, a byte or halfword in two.
Cycle Pipeline::reserve_port(const ProgramInstruction& what, std::span<const MemoryAccess> accesses,
                             Cycle from) {
  const std::uint32_t cycles =
      is_narrow(what.instruction.kind) ? constants_.narrow_agu_cycles : doublewords(accesses);
  return port_slots_.take(from, cycles);
}

// Loaded registers in ascending order are those of the accesses; every doubleword of a multiple
// load comes a cycle after the one before.
Cycle Pipeline::load(const ProgramInstruction& what, std::span<const MemoryAccess> accesses,
                     Cycle issued) {
  const Instruction& instruction = what.instruction;
  const bool narrow = is_narrow(instruction.kind);
  Cycle ready = 0;
  Cycle at = issued;
  std::uint32_t doubleword = accesses.front().address / 8;
  CoreSet left = instruction.writes;
  for (const MemoryAccess& access : accesses) {
    at += access.address / 8 != doubleword ? 1 : 0;
    doubleword = access.address / 8;
    const std::uint32_t last = access.address + access.bytes - 1;
    Cycle hit = memory_.load(access.address, at, &access != &accesses.front());
    if (last / 8 != access.address / 8) {
      hit = std::max(hit, memory_.load(last, at, true)) +
            (narrow || instruction.kind == Kind::kLoad ? constants_.cross_doubleword_extra : 1);
    } else if (last / 4 != access.address / 4 && access.bytes <= 4) {
      hit += constants_.cross_word_extra;
    }
    ready = std::max(ready, hit + constants_.load_to_use + (narrow ? constants_.narrow_extra : 0) +
                                (instruction.scaled_index ? 1 : 0));
    if (left != 0 && accesses.size() > 1) {
      const CoreSet lowest = left & (~left + 1);
      write(lowest, ready, 0);
      left &= left - 1;
    }
  }
  write(left, ready, 0);
  write_vector(instruction.vector_writes, ready);
  if (!instruction.conditional && !instruction.late_result) {
    forwarded_ |= instruction.writes;
  }
  return ready;
}

Cycle Pipeline::data_ready(const Instruction& store) const {
  return std::max(core_ready(store.reads, false), vector_ready(store.vector_reads, 1));
}

// A store goes to the store buffer when everything before it has been done.
Cycle Pipeline::store(const ProgramInstruction& what, std::span<const MemoryAccess> accesses,
                      Cycle issued) {
  Cycle when = std::max({issued + 1, data_ready(what.instruction), retired_});
  for (const MemoryAccess& access : accesses) {
    const std::uint32_t in_first = std::min<std::uint32_t>(access.bytes, 8 - access.address % 8);
    when = memory_.store(access.address, in_first, when);
    if (in_first < access.bytes) {
      when = memory_.store(access.address + in_first, access.bytes - in_first, when + 1);
    }
  }
  return when;
}

// Fetch goes on at another place. dispatch() counts the cycle of a pair at its even address; a pair
// that is entered in the middle is counted here.
void Pipeline::steer_fetch(const ProgramInstruction& what, std::uint32_t next, Cycle resolved) {
  const bool taken = goes_elsewhere(what.instruction, what.address, next);
  ++branch_counts_.branches;
  if (!predictor_.foresees(what.instruction, what.address, next)) {
    ++branch_counts_.mispredicts;
    fetched_ = std::max(fetched_, resolved + constants_.mispredict_penalty - 1);
  } else if (taken) {
    fetched_ += constants_.taken_branch_bubble;
  } else {
    return;
  }
  fetched_ += (next & 4) != 0 ? 1 : 0;
}

Counters Pipeline::counters() const {
  const MemoryCounts& memory = memory_.counts();
  const TlbCounts& tlb = memory_.tlb_counts();
  return {.instructions = instructions_,
          .cycles = std::max(retired_, vector_free_),
          .l1i_refills = memory.instruction_refills,
          .l1d_refills = memory.data_refills,
          .l1d_evictions = memory.data_evictions,
          .streamed_lines = memory.streamed_lines,
          .l2_misses = memory.l2_misses,
          .ddr_reads = memory.ddr_reads,
          .ddr_writes = memory.ddr_writes,
          .branches = branch_counts_.branches,
          .mispredicts = branch_counts_.mispredicts,
          .tlb_misses = tlb.micro_misses,
          .walks = tlb.walks,
          .unknown = unknown_};
}

}  // namespace iog::a9_model
