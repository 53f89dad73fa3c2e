// What a timing model needs to know of an A32 instruction: what it does to time, which registers it
// reads and writes, whether it moves the program counter.
#pragma once

#include <cstdint>

namespace iog::a9_model {

// The instructions of one kind have one line in timing.cpp. Names of groups are those of the tables
// in the Cortex-A9 TRM (ARM DDI 0388), appendix B, and in the NEON MPE TRM (ARM DDI 0409),
// chapter 3.
enum class Kind : std::uint8_t {
  kUnknown,  // no A32 encoding that this decoder knows
  kNop,      // hints, preloads of code, coprocessor no-operations
  kSystem,   // barriers, status and coprocessor registers: waits for everything before it
  kBranch,
  // Core data processing, table B-1.
  kMove,               // MOV, MOVW, MOVT, CLZ, REV: one cycle with or without a constant shift
  kMoveRegisterShift,  // MOV with a shift by register
  kAlu,                // ADD, CMP, AND, ... without a shift; parallel additions without saturation
  kAluShift,           // ... with a shift by a constant; PKHBT, PKHTB with a shift
  kAluRegisterShift,   // ... with a shift by register
  kSaturatingAdd,      // QADD, UQSUB8, UHADD8, ...
  kSaturate,           // SSAT, USAT, QDADD, QDSUB
  kExtend,             // SXTB, UXTH, ...
  kExtendAdd,          // SXTAB, UXTAH, ...
  kBitField,           // BFC, BFI, UBFX, SBFX
  kMultiply,           // 32 x 32, most or least significant half, with or without accumulation
  kMultiply16,         // 16 x 16 and dual 16 x 16
  kMultiplyLong,       // 64-bit results
  // Memory.
  kLoad,
  kLoadNarrow,  // byte or halfword
  kLoadMultiple,
  kStore,
  kStoreNarrow,
  kStoreMultiple,
  kPreload,  // PLD
  kVectorLoad,
  kVectorStore,
  // VFP.
  kVfpMove,
  kVfpAdd,
  kVfpConvert,
  kVfpCompare,
  kVfpMultiplySingle,
  kVfpMultiplyDouble,
  kVfpMultiplyAddSingle,
  kVfpMultiplyAddDouble,
  kVfpDivideSingle,
  kVfpDivideDouble,
  kVfpRootSingle,
  kVfpRootDouble,
  // Advanced SIMD. A q register costs a second cycle where Instruction::quad says so.
  kNeonSimple,           // VADD, VAND, ...: operands at N2, result at N3
  kNeonShift,            // VSHL, VSUBL, VMOV, ...: operands at N1, result at N3
  kNeonCompare,          // VQADD, VMAX, VCGT, VHADD, ...: operands at N2, result at N4
  kNeonSaturatingShift,  // VQSHL, VQMOVN, VRSHL, ...: operands at N1, result at N4
  kNeonAccumulate,       // VABA, VSRA, VPADAL: result at N6
  kNeonMultiply,
  kNeonMultiplyAdd,
  kNeonPermute,  // VEXT, VTRN, VZIP, VREV, VTBL, VDUP from a scalar
  kNeonFloatAdd,
  kNeonFloatMultiply,
  kNeonFloatMultiplyAdd,
  kNeonReciprocalStep,
  // Between the register files.
  kCoreToVector,
  kVectorToCore,
  kCount
};

enum class Flow : std::uint8_t { kNone, kJump, kCall, kIndirect, kIndirectCall, kReturn };

// Registers of the core are bits of one word: r0 to r15 and the flags. Those of the vectors are
// bits of another: s0 to s31, where d0 to d15 are pairs of them, d16 to d31, the flags of FPSCR.
using CoreSet = std::uint32_t;
using VectorSet = std::uint64_t;

inline constexpr unsigned kStackPointer = 13;
inline constexpr unsigned kLinkRegister = 14;
inline constexpr unsigned kProgramCounter = 15;
inline constexpr unsigned kFlags = 16;
inline constexpr unsigned kCoreRegisters = 17;

inline constexpr unsigned kSingles = 32;
inline constexpr unsigned kVectorFlags = 48;
inline constexpr unsigned kVectorRegisters = 49;

constexpr CoreSet core_bit(unsigned index) { return CoreSet{1} << index; }
constexpr VectorSet vector_bit(unsigned index) { return VectorSet{1} << index; }

// s registers, and d registers, in a row from one on; those past the last are ignored.
constexpr VectorSet singles(unsigned first, unsigned count) {
  VectorSet set = 0;
  for (unsigned index = first; index < first + count && index < kSingles; ++index) {
    set |= vector_bit(index);
  }
  return set;
}
constexpr VectorSet doubles(unsigned first, unsigned count) {
  VectorSet set = 0;
  for (unsigned index = first; index < first + count && index < 32; ++index) {
    set |= index < 16 ? singles(2 * index, 2) : vector_bit(kSingles + index - 16);
  }
  return set;
}

struct Instruction {
  CoreSet reads = 0;          // operands; what a store stores
  CoreSet address_reads = 0;  // base and index of a memory access
  CoreSet writes = 0;         // results, loaded registers
  CoreSet base_writes = 0;    // the base register where it is written back
  VectorSet vector_reads = 0;
  VectorSet vector_writes = 0;
  Kind kind = Kind::kUnknown;
  Flow flow = Flow::kNone;
  bool conditional = false;
  bool quad = false;          // a q register is written, or two results by a permutation
  bool scaled_index = false;  // an index with another shift than LSL #2
  bool fast_forward = false;  // takes a loaded value a cycle early (DDI 0388, B.3)
  bool late_result = false;   // a load that extends a sign: nobody gets it early
  std::uint8_t marker = kNoMarker;

  static constexpr std::uint8_t kNoMarker = 0xff;
};

}  // namespace iog::a9_model
