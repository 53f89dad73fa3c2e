#include "decode.hpp"

#include "decode_spaces.hpp"

namespace iog::a9_model {
namespace {

using namespace spaces;  // NOLINT(google-build-using-namespace): they are this file's own

constexpr std::uint32_t kAlways = 0xe;
constexpr std::uint32_t kUnconditional = 0xf;

// A5.2.12 where bit 7 is 0: status registers, BX, CLZ, saturating additions, BKPT and the like.
Instruction miscellaneous(std::uint32_t word) {
  const std::uint32_t opcode = bits(word, 22, 21);
  switch (bits(word, 6, 4)) {
    case 0: {
      Instruction result = of(Kind::kSystem);
      if (!bit(word, 21)) {  // MRS
        result.kind = Kind::kMove;
        result.reads = core_bit(kFlags);
        result.writes = field(word, 12);
      } else if (bits(word, 17, 16) == 0 && opcode == 1) {  // MSR of the flags alone
        result.kind = Kind::kMove;
        result.reads = field(word, 0);
        result.writes = core_bit(kFlags);
      }
      return result;
    }
    case 1: {
      if (opcode == 3) {
        Instruction result = of(Kind::kMove);  // CLZ
        result.reads = field(word, 0);
        result.writes = field(word, 12);
        return result;
      }
      Instruction result = of(opcode == 1 ? Kind::kBranch : Kind::kUnknown);  // BX
      result.reads = field(word, 0);
      result.flow = bits(word, 3, 0) == kLinkRegister ? Flow::kReturn : Flow::kIndirect;
      return result;
    }
    case 3: {  // BLX to a register
      Instruction result = of(opcode == 1 ? Kind::kBranch : Kind::kUnknown);
      result.reads = field(word, 0);
      result.writes = core_bit(kLinkRegister);
      result.flow = Flow::kIndirectCall;
      return result;
    }
    case 5: {
      Instruction result = of(opcode < 2 ? Kind::kSaturatingAdd : Kind::kSaturate);
      result.reads = field(word, 0) | field(word, 16);
      result.writes = field(word, 12);
      return result;
    }
    case 7:
      return of(Kind::kSystem);  // BKPT, SMC
    default:
      return of(Kind::kUnknown);
  }
}

Instruction decode_register_or_multiply(std::uint32_t word) {
  const bool is_misc = bits(word, 24, 23) == 2 && !bit(word, 20);
  if (bit(word, 7) && bit(word, 4)) {
    if (bits(word, 6, 5) == 0 && !bit(word, 24)) {
      return multiply(word);
    }
    return extra_load_store(word);
  }
  if (is_misc) {
    return bit(word, 7) ? halfword_multiply(word) : miscellaneous(word);
  }
  return data_processing(word);
}

// A5.2.11: MSR with an immediate, and the hints. A DBG is a marker (marker.hpp).
Instruction decode_immediate(std::uint32_t word) {
  const std::uint32_t op = bits(word, 24, 20);
  if (op == 0x10 || op == 0x14) {  // MOVW, MOVT
    Instruction result = of(Kind::kMove);
    result.writes = field(word, 12);
    result.reads = op == 0x14 ? field(word, 12) : 0;
    return result;
  }
  if (op == 0x12 || op == 0x16) {
    Instruction result = of(Kind::kSystem);
    if (op == 0x12 && bits(word, 19, 16) == 0) {
      result.kind = Kind::kNop;
      if (bits(word, 7, 4) == 0xf) {
        result.marker = static_cast<std::uint8_t>(bits(word, 3, 0));
      }
    } else if (op == 0x12 && bits(word, 17, 16) == 0) {
      result.kind = Kind::kMove;
      result.writes = core_bit(kFlags);
    }
    return result;
  }
  return data_processing(word);
}

Instruction decode_branch(std::uint32_t word) {
  Instruction result = of(Kind::kBranch);
  result.flow = bit(word, 24) ? Flow::kCall : Flow::kJump;
  result.writes = bit(word, 24) ? core_bit(kLinkRegister) : 0;
  return result;
}

// A5.7: what the condition field of ones makes of the rest, without Advanced SIMD.
Instruction decode_unconditional(std::uint32_t word) {
  if (bits(word, 27, 26) == 1) {
    const std::uint32_t op = bits(word, 25, 20);
    if (op == 0x17) {
      return of(Kind::kSystem);  // CLREX, DSB, DMB, ISB
    }
    const bool is_data = (op & 0x17) == 0x15 || (op & 0x17) == 0x11;
    const bool is_code = (op & 0x17) == 0x05;
    if (is_data || is_code) {
      Instruction result = of(is_data ? Kind::kPreload : Kind::kNop);
      result.address_reads = field(word, 16) | (bit(word, 25) ? field(word, 0) : 0);
      return result;
    }
    return of(Kind::kUnknown);
  }
  if (bits(word, 27, 25) == 5) {  // BLX to Thumb
    return decode_branch(word | 1u << 24);
  }
  return of(Kind::kSystem);  // CPS, SETEND, SRS, RFE, second coprocessor space
}

}  // namespace

Instruction decode(std::uint32_t word) {
  const std::uint32_t condition = bits(word, 31, 28);
  const bool in_vector_space =
      condition == kUnconditional
          ? bits(word, 27, 25) == 1 || (bits(word, 27, 24) == 4 && !bit(word, 20))
          : (bits(word, 27, 25) == 6 || bits(word, 27, 24) == 14) && bits(word, 11, 9) == 5;
  if (condition == kUnconditional && !in_vector_space) {
    return decode_unconditional(word);
  }
  Instruction result;
  if (in_vector_space) {
    result = condition == kUnconditional ? simd(word) : vfp(word);
  } else {
    switch (bits(word, 27, 25)) {
      case 0:
        result = decode_register_or_multiply(word);
        break;
      case 1:
        result = decode_immediate(word);
        break;
      case 2:
        result = load_store(word);
        break;
      case 3:
        result = bit(word, 4) ? media(word) : load_store(word);
        break;
      case 4:
        result = load_store_multiple(word);
        break;
      case 5:
        result = decode_branch(word);
        break;
      default:
        result = of(Kind::kSystem);  // other coprocessors, SVC
        break;
    }
  }
  result.conditional = condition < kAlways;
  if (result.conditional) {
    // What is not executed leaves the old value, which is therefore an operand.
    result.reads |= core_bit(kFlags);
    const bool is_memory = result.kind >= Kind::kLoad && result.kind <= Kind::kVectorStore;
    result.reads |= is_memory ? 0 : result.writes & ~core_bit(kProgramCounter);
    result.vector_reads |= is_memory ? 0 : result.vector_writes;
  }
  return result;
}

}  // namespace iog::a9_model
