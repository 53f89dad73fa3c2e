// Data processing, multiplication and media instructions of the core.
#include "decode_spaces.hpp"

namespace iog::a9_model::spaces {

// ARM ARM A5.2.1 to A5.2.3: AND, EOR, SUB, ... MVN.
Instruction data_processing(std::uint32_t word) {
  const std::uint32_t opcode = bits(word, 24, 21);
  const bool immediate = bit(word, 25);
  const bool by_register = !immediate && bit(word, 4);
  const bool shifted = !immediate && (by_register || bits(word, 11, 5) != 0);
  const bool is_move = opcode == 13;
  const bool only_flags = (opcode & 0xc) == 8;
  const bool uses_carry = opcode >= 5 && opcode <= 7;

  Instruction result = of(is_move ? Kind::kMove : Kind::kAlu);
  if (by_register) {
    result.kind = is_move ? Kind::kMoveRegisterShift : Kind::kAluRegisterShift;
  } else if (shifted && !is_move) {
    result.kind = Kind::kAluShift;
  }
  result.fast_forward = !shifted;
  result.reads = (immediate ? 0 : field(word, 0)) | (by_register ? field(word, 8) : 0);
  if (!is_move && opcode != 15) {
    result.reads |= field(word, 16);
  }
  if (uses_carry) {
    result.reads |= core_bit(kFlags);
  }
  result.writes = only_flags ? 0 : field(word, 12);
  if (bit(word, 20)) {
    result.writes |= core_bit(kFlags);
  }
  note_jump(result, is_move && !shifted && bits(word, 3, 0) == kLinkRegister);
  return result;
}

// A5.2.5: rd is in bits 19 to 16; the accumulator, or the lower half, in bits 15 to 12.
Instruction multiply(std::uint32_t word) {
  const std::uint32_t opcode = bits(word, 23, 20);
  const bool is_long = opcode >= 8 || opcode == 4;  // UMAAL is 4
  Instruction result = of(is_long ? Kind::kMultiplyLong : Kind::kMultiply);
  result.reads = field(word, 0) | field(word, 8);
  result.writes = field(word, 16);
  const bool accumulates = (opcode & 2) != 0 || opcode == 4 || opcode == 6;  // MLA, MLS, xMLAL
  if (is_long) {
    result.writes |= field(word, 12);
    result.reads |= accumulates ? field(word, 12) | field(word, 16) : 0;
  } else if (accumulates) {
    result.reads |= field(word, 12);
  }
  if (opcode != 4 && opcode != 6 && bit(word, 20)) {
    result.writes |= core_bit(kFlags);
  }
  return result;
}

// A5.2.7: SMLAxy, SMLAWy, SMULWy, SMLALxy, SMULxy.
Instruction halfword_multiply(std::uint32_t word) {
  const std::uint32_t opcode = bits(word, 22, 21);
  Instruction result = of(Kind::kMultiply16);
  result.reads = field(word, 0) | field(word, 8);
  result.writes = field(word, 16);
  const bool only_product = opcode == 3 || (opcode == 1 && bit(word, 5));
  if (opcode == 2) {
    result.writes |= field(word, 12);
    result.reads |= field(word, 12) | field(word, 16);
  } else if (!only_product) {
    result.reads |= field(word, 12);
    result.writes |= core_bit(kFlags);  // Q
  }
  return result;
}

namespace {

// A5.4.1 and A5.4.2: parallel additions; the prefix is in bits 21 and 20: plain (1), saturating (2)
// and halving (3).
Instruction parallel(std::uint32_t word) {
  Instruction result = of(bits(word, 21, 20) == 1 ? Kind::kAlu : Kind::kSaturatingAdd);
  result.reads = field(word, 0) | field(word, 16);
  result.writes = field(word, 12);
  if (bits(word, 21, 20) == 1) {
    result.writes |= core_bit(kFlags);  // GE
  }
  return result;
}

// A5.4.3: packing, saturation, extension, reversal, SEL.
Instruction pack_saturate_reverse(std::uint32_t word) {
  const std::uint32_t op1 = bits(word, 22, 20);
  const std::uint32_t op2 = bits(word, 7, 5);
  Instruction result;
  result.reads = field(word, 0);
  result.writes = field(word, 12);
  if (op2 == 3) {
    const bool adds = bits(word, 19, 16) != 15;
    result.kind = adds ? Kind::kExtendAdd : Kind::kExtend;
    result.reads |= adds ? field(word, 16) : 0;
  } else if ((op2 & 1) == 0 && op1 == 0) {  // PKHBT, PKHTB
    result.kind = bits(word, 11, 7) == 0 ? Kind::kAlu : Kind::kAluShift;
    result.reads |= field(word, 16);
  } else if ((op2 & 1) == 0 && (op1 & 2) != 0) {
    result.kind = Kind::kSaturate;
    result.fast_forward = bits(word, 11, 7) == 0;
  } else if (op2 == 1 && (op1 & 3) == 2) {  // SSAT16, USAT16
    result.kind = Kind::kAlu;
    result.fast_forward = true;
  } else if (op2 == 5 && op1 == 0) {  // SEL
    result.kind = Kind::kAlu;
    result.reads |= field(word, 16) | core_bit(kFlags);
  } else if ((op2 == 1 || op2 == 5) && (op1 & 2) != 0) {  // REV, REV16, RBIT, REVSH
    result.kind = Kind::kMove;
  } else {
    return of(Kind::kUnknown);
  }
  return result;
}

// A5.4.4 signed multiplications, and the sum of absolute differences beside them.
Instruction media_multiply(std::uint32_t word) {
  const std::uint32_t op1 = bits(word, 22, 20);
  Instruction result = of(Kind::kMultiply16);
  result.reads = field(word, 0) | field(word, 8);
  result.writes = field(word, 16);
  const bool accumulates = bits(word, 15, 12) != 15;
  if (op1 == 4) {
    result.kind = Kind::kMultiplyLong;
    result.writes |= field(word, 12);
    result.reads |= field(word, 12) | field(word, 16);
    return result;
  }
  if (op1 == 5) {
    result.kind = Kind::kMultiply;
  }
  result.reads |= accumulates ? field(word, 12) : 0;
  return result;
}

}  // namespace

// A5.4: the media instructions.
Instruction media(std::uint32_t word) {
  switch (bits(word, 24, 23)) {
    case 0:
      return parallel(word);
    case 1:
      return pack_saturate_reverse(word);
    case 2:
      return media_multiply(word);
    default:
      break;
  }
  if (bits(word, 22, 20) == 0 && bits(word, 7, 5) == 0) {  // USAD8, USADA8
    return media_multiply(word);
  }
  const bool extracts = (bits(word, 22, 20) & 2) != 0 && bits(word, 6, 5) == 2;
  const bool inserts = (bits(word, 22, 21)) == 2 && bits(word, 6, 5) == 0;
  if (!extracts && !inserts) {
    return of(Kind::kUnknown);
  }
  Instruction result = of(Kind::kBitField);
  result.writes = field(word, 12);
  const bool clears = inserts && bits(word, 3, 0) == 15;
  result.reads = (clears ? 0 : field(word, 0)) | (inserts ? field(word, 12) : 0);
  return result;
}

}  // namespace iog::a9_model::spaces
