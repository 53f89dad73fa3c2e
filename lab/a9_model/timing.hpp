// How long the pipelines are busy with an instruction and when its result is there.
#pragma once

#include <cstdint>

#include "constants.hpp"
#include "instruction.hpp"

namespace iog::a9_model {

enum class Unit : std::uint8_t { kNone, kAlu, kMultiplier, kMemory, kVector, kBranch, kSerial };

struct Timing {
  Unit unit = Unit::kNone;
  std::uint8_t occupies = 1;  // cycles before the unit takes the next instruction
  // Core: cycles from issue to the first result, and what a second one comes later. Vector: stages.
  std::uint8_t latency = 1;
  std::uint8_t second_result = 0;
  std::uint8_t read_stage = 1;  // vector: the stage, from 1, that reads the operands
};

Timing timing_of(const Instruction& instruction, const Constants& constants);

}  // namespace iog::a9_model
