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

// Registers are bits of one word: r0 to r15, the flags of the core, those of FPSCR, d0 to d31.
using RegisterSet = std::uint64_t;
inline constexpr unsigned kFlags = 16;
inline constexpr unsigned kVectorFlags = 17;
inline constexpr unsigned kFirstVector = 32;
inline constexpr unsigned kRegisters = 64;
inline constexpr unsigned kLinkRegister = 14;
inline constexpr unsigned kProgramCounter = 15;

constexpr RegisterSet register_bit(unsigned index) { return RegisterSet{1} << index; }

struct Instruction {
  RegisterSet reads = 0;          // operands; what a store stores
  RegisterSet address_reads = 0;  // base and index of a memory access
  RegisterSet writes = 0;         // results, loaded registers
  RegisterSet base_writes = 0;    // the base register where it is written back
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
