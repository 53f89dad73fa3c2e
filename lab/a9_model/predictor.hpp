// Branch prediction of the Cortex-A9 (TRM 7.3): a global history buffer of 4096 two-bit counters, a
// branch target address cache of 512 entries in two ways, a return stack of eight.
//
// How history and address make an index is not published; here they are combined by exclusive or.
#pragma once

#include <array>
#include <cstdint>

#include "instruction.hpp"

namespace iog::a9_model {

struct BranchCounts {
  std::uint64_t branches = 0;
  std::uint64_t mispredicts = 0;
};

// Was this branch taken? One without a condition always is, even to the instruction behind it.
inline bool goes_elsewhere(const Instruction& branch, std::uint32_t address, std::uint32_t next) {
  return next != address + 4 || (branch.flow != Flow::kNone && !branch.conditional);
}

class Predictor {
 public:
  explicit Predictor(std::uint32_t history_bits) : history_mask_((1u << history_bits) - 1) {}

  // A branch at address went to next, which is address + 4 if it was not taken. Was that foreseen?
  // Learns from it.
  bool foresees(const Instruction& branch, std::uint32_t address, std::uint32_t next);

 private:
  static constexpr std::uint32_t kCounters = 4096;
  static constexpr std::uint32_t kTargetSets = 256;
  static constexpr std::uint32_t kReturns = 8;

  struct Target {
    std::uint32_t branch = 1;  // no instruction is at an odd address
    std::uint32_t target = 0;
  };

  bool foresees_direction(std::uint32_t address, bool taken);
  bool foresees_target(std::uint32_t address, std::uint32_t target);
  bool foresees_return(std::uint32_t target);
  void push_return(std::uint32_t address);

  std::uint32_t history_mask_;
  std::uint32_t history_ = 0;
  std::array<std::uint8_t, kCounters> counters_{};            // 2 and 3: taken
  std::array<std::array<Target, 2>, kTargetSets> targets_{};  // the more recent first
  std::array<std::uint32_t, kReturns> returns_{};
  std::uint32_t return_top_ = 0;
};

}  // namespace iog::a9_model
