#include "timing.hpp"

namespace iog::a9_model {
namespace {

// Cycles of TRM table B-1; the unit is free again after one of them, if the ALUs are pipelined.
Timing alu(std::uint8_t cycles, const Constants& constants) {
  const std::uint8_t occupies = constants.shift_occupies != 0 ? cycles : std::uint8_t{1};
  return {.unit = Unit::kAlu, .occupies = occupies, .latency = cycles};
}

// TRM table B-5: cycles of the multiplier, and when the result is there. The upper half of a long
// product comes a cycle later.
Timing multiply(std::uint8_t cycles, std::uint8_t latency, std::uint8_t second = 0) {
  return {
      .unit = Unit::kMultiplier, .occupies = cycles, .latency = latency, .second_result = second};
}

Timing memory() { return {.unit = Unit::kMemory}; }

// VFP: issue interval and latency by LLVM, which agrees with GCC but for multiplications.
Timing vfp(std::uint8_t occupies, std::uint8_t latency) {
  return {.unit = Unit::kVector, .occupies = occupies, .latency = latency};
}

// Advanced SIMD: operands read in one stage, the result at the end of another; a second cycle for q
// registers makes it one later.
Timing neon(std::uint8_t cycles, std::uint8_t read_stage, std::uint8_t result_stage) {
  const auto latency = static_cast<std::uint8_t>(result_stage + cycles - 1);
  return {.unit = Unit::kVector, .occupies = cycles, .latency = latency, .read_stage = read_stage};
}

Timing core_timing(Kind kind, const Constants& constants) {
  switch (kind) {
    case Kind::kNop:
      return {};
    case Kind::kBranch:
      return {.unit = Unit::kBranch};
    case Kind::kMove:
    case Kind::kAlu:
      return alu(1, constants);
    case Kind::kMoveRegisterShift:
    case Kind::kAluShift:
    case Kind::kSaturatingAdd:
    case Kind::kExtend:
    case Kind::kBitField:
      return alu(2, constants);
    case Kind::kAluRegisterShift:
    case Kind::kSaturate:
    case Kind::kExtendAdd:
      return alu(3, constants);
    case Kind::kMultiply:
      return multiply(2, 4);
    case Kind::kMultiply16:
      return multiply(1, 3);
    case Kind::kMultiplyLong:
      return multiply(3, 4, 1);
    default:
      return {.unit = Unit::kSerial};
  }
}

Timing vfp_timing(Kind kind) {
  switch (kind) {
    case Kind::kVfpMove:
      return vfp(1, 1);
    case Kind::kVfpCompare:
      return vfp(1, 4);  // the flags are written back after four cycles, says LLVM
    case Kind::kVfpMultiplySingle:
      return vfp(1, 5);
    case Kind::kVfpMultiplyDouble:
      return vfp(2, 6);
    case Kind::kVfpMultiplyAddSingle:
      return vfp(1, 8);
    case Kind::kVfpMultiplyAddDouble:
      return vfp(2, 9);
    case Kind::kVfpDivideSingle:
      return vfp(10, 15);
    case Kind::kVfpDivideDouble:
      return vfp(20, 25);
    case Kind::kVfpRootSingle:
      return vfp(13, 17);
    case Kind::kVfpRootDouble:
      return vfp(28, 32);
    default:
      return vfp(1, 4);  // additions and conversions
  }
}

Timing neon_timing(const Instruction& instruction, const Constants& constants) {
  const std::uint8_t wide = instruction.quad ? 2 : 1;
  const auto integer =
      static_cast<std::uint8_t>(instruction.quad ? constants.quad_integer_cycles : 1);
  switch (instruction.kind) {
    case Kind::kNeonSimple:
      return neon(integer, 2, 3);
    case Kind::kNeonShift:
      return neon(integer, 1, 3);
    case Kind::kNeonCompare:
      return neon(integer, 2, 4);
    case Kind::kNeonSaturatingShift:
      return neon(wide, 1, 4);
    case Kind::kNeonAccumulate:
      return neon(wide, 1, 6);
    case Kind::kNeonMultiply:
    case Kind::kNeonMultiplyAdd:
      return neon(wide, 2, 6);
    case Kind::kNeonPermute:
      return neon(wide, 1, 2);
    case Kind::kNeonFloatAdd:
      return neon(wide, 2, 5);
    case Kind::kNeonFloatMultiply:
      return neon(wide, 1, 5);
    default:
      return neon(wide, 2, 9);  // float multiplication then addition, reciprocal steps
  }
}

}  // namespace

Timing timing_of(const Instruction& instruction, const Constants& constants) {
  const Kind kind = instruction.kind;
  if (kind >= Kind::kLoad && kind <= Kind::kVectorStore) {
    return memory();
  }
  if (kind >= Kind::kVfpMove && kind <= Kind::kVfpRootDouble) {
    return vfp_timing(kind);
  }
  if (kind >= Kind::kNeonSimple && kind <= Kind::kNeonReciprocalStep) {
    return neon_timing(instruction, constants);
  }
  if (kind == Kind::kCoreToVector) {
    return neon(1, 1, 2);
  }
  if (kind == Kind::kVectorToCore) {
    return vfp(1, static_cast<std::uint8_t>(constants.vector_to_core));
  }
  return core_timing(kind, constants);
}

}  // namespace iog::a9_model
