// The core: what happens to the instructions of one program in the order in which they executed.
//
// Two a cycle enter a window, in order; each begins when its operands and a pipeline are free, and
// leaves the window in order. Vector instructions begin in their own order behind a queue.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "counters.hpp"
#include "issue_slots.hpp"
#include "memory_system.hpp"
#include "predictor.hpp"
#include "stage_map.hpp"
#include "timing.hpp"

namespace iog::a9_model {

struct MemoryAccess {
  std::uint32_t address;
  std::uint8_t bytes;
};

// An instruction of the program, decoded once.
struct ProgramInstruction {
  std::uint32_t address = 0;
  std::uint32_t word = 0;
  Instruction instruction;
  Timing timing;
  Place place{};
};

class Pipeline {
 public:
  explicit Pipeline(const Constants& constants);

  // One instruction has executed, with these accesses in ascending order; next is the address of
  // the one after it.
  void execute(const ProgramInstruction& what, std::span<const MemoryAccess> accesses,
               std::uint32_t next);

  // See MemorySystem.
  void set_uncached(std::uint32_t begin, std::uint32_t bytes) {
    memory_.set_uncached(begin, bytes);
  }

  void keep_l2(bool keep) { memory_.keep_l2(keep); }
  [[nodiscard]] Counters counters() const;

 private:
  static constexpr std::size_t kRing = 64;

  Cycle dispatch(const ProgramInstruction& what);
  [[nodiscard]] Cycle core_ready(CoreSet reads, bool fast_forward) const;
  [[nodiscard]] Cycle vector_ready(VectorSet reads, std::uint32_t read_stage) const;
  [[nodiscard]] Cycle data_ready(const Instruction& store) const;
  void write(CoreSet results, Cycle ready, Cycle later_by);
  void write_vector(VectorSet results, Cycle ready);

  // When it has left the pipelines.
  Cycle execute_alu(const ProgramInstruction& what, Cycle dispatched);
  Cycle execute_vector(const ProgramInstruction& what, Cycle dispatched);
  Cycle execute_memory(const ProgramInstruction& what, std::span<const MemoryAccess> accesses,
                       Cycle dispatched);
  Cycle load(const ProgramInstruction& what, std::span<const MemoryAccess> accesses, Cycle issued);
  Cycle store(const ProgramInstruction& what, std::span<const MemoryAccess> accesses, Cycle issued);
  Cycle reserve_port(const ProgramInstruction& what, std::span<const MemoryAccess> accesses,
                     Cycle from);
  void steer_fetch(const ProgramInstruction& what, std::uint32_t next, Cycle resolved);

  Constants constants_;
  MemorySystem memory_;
  Predictor predictor_;
  BranchCounts branch_counts_;
  std::uint64_t instructions_ = 0;
  std::uint64_t unknown_ = 0;

  Cycle fetched_ = 0;
  Cycle dispatched_ = 0;
  std::uint32_t dispatched_now_ = 0;  // in that cycle
  Cycle retired_ = 0;
  std::array<Cycle, kRing> dispatch_times_{};
  std::array<Cycle, kRing> retire_times_{};
  std::array<Cycle, kRing> vector_times_{};
  std::uint64_t vector_count_ = 0;

  std::array<Cycle, kCoreRegisters> ready_{};
  std::array<Cycle, kVectorRegisters> vector_ready_{};
  CoreSet forwarded_ = 0;  // loaded registers that the ALUs can have a cycle earlier
  IssueSlots alu_slots_;
  IssueSlots port_slots_;
  Cycle multiplier_free_ = 0;
  Cycle vector_free_ = 0;
  Cycle address_order_ = 0;  // when the memory instruction before had its address
};

}  // namespace iog::a9_model
