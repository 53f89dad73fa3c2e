#include "predictor.hpp"

#include <utility>

namespace iog::a9_model {

bool Predictor::foresees(const Instruction& branch, std::uint32_t address, std::uint32_t next) {
  const bool taken = goes_elsewhere(branch, address, next);
  bool foreseen = true;
  if (branch.conditional) {
    foreseen = foresees_direction(address, taken);
  }
  if (!taken) {
    return foreseen;
  }
  if (branch.flow == Flow::kReturn) {
    return foresees_return(next) && foreseen;
  }
  if (branch.flow == Flow::kCall || branch.flow == Flow::kIndirectCall) {
    push_return(address + 4);
  }
  return foresees_target(address, next) && foreseen;
}

// The counters start at strongly not taken. Only conditional branches are history.
bool Predictor::foresees_direction(std::uint32_t address, bool taken) {
  std::uint8_t& counter = counters_[((address >> 2) ^ history_) % kCounters];
  const bool foreseen = (counter >= 2) == taken;
  if (taken && counter < 3) {
    ++counter;
  } else if (!taken && counter > 0) {
    --counter;
  }
  history_ = (history_ << 1 | (taken ? 1u : 0u)) & history_mask_;
  return foreseen;
}

bool Predictor::foresees_target(std::uint32_t address, std::uint32_t target) {
  auto& set = targets_[(address >> 2) % kTargetSets];
  if (set[0].branch != address) {
    std::swap(set[0], set[1]);
    if (set[0].branch != address) {
      set[0] = {.branch = address, .target = target};
      return false;
    }
  }
  return std::exchange(set[0].target, target) == target;
}

bool Predictor::foresees_return(std::uint32_t target) {
  return_top_ = (return_top_ + kReturns - 1) % kReturns;
  return returns_[return_top_] == target;
}

void Predictor::push_return(std::uint32_t address) {
  returns_[return_top_] = address;
  return_top_ = (return_top_ + 1) % kReturns;
}

}  // namespace iog::a9_model
