// VFP and Advanced SIMD: ARM ARM chapter A7.
#include "decode_core.hpp"

namespace iog::a9_model {
namespace {

using core::field;
using core::of;

// Up to 32 consecutive d registers.
RegisterSet vectors(unsigned first, unsigned count) {
  RegisterSet set = 0;
  for (unsigned index = first; index < first + count && index < 32; ++index) {
    set |= register_bit(kFirstVector + index);
  }
  return set;
}

// The d register of a field of four bits and its fifth one. A single-precision register is half of
// the d register that the four bits alone number, and is taken for the whole.
unsigned number(std::uint32_t word, unsigned low, unsigned fifth) {
  return bits(word, low + 3, low) | (bit(word, fifth) ? 16u : 0u);
}
unsigned vfp_number(std::uint32_t word, unsigned low, unsigned fifth) {
  return bit(word, 8) ? number(word, low, fifth) : bits(word, low + 3, low);
}

Kind by_precision(std::uint32_t word, Kind single, Kind twice) {
  return bit(word, 8) ? twice : single;
}

// Table A7-17: the operations with one operand.
Instruction vfp_unary(std::uint32_t word) {
  const std::uint32_t opc2 = bits(word, 19, 16);
  const RegisterSet d = vectors(vfp_number(word, 12, 22), 1);
  const RegisterSet m = vectors(vfp_number(word, 0, 5), 1);
  Instruction result = of(Kind::kVfpMove);
  result.writes = d;
  if (!bit(word, 6)) {  // VMOV with an immediate
    return result;
  }
  result.reads = m;
  if (opc2 == 1 && bit(word, 7)) {
    result.kind = by_precision(word, Kind::kVfpRootSingle, Kind::kVfpRootDouble);
  } else if (opc2 == 4 || opc2 == 5) {
    result.kind = Kind::kVfpCompare;
    result.reads = d | (opc2 == 4 ? m : 0);
    result.writes = register_bit(kVectorFlags);
  } else if (opc2 >= 2) {
    result.kind = Kind::kVfpConvert;
    // The other side of a conversion may have the other precision; both readings are registers.
    result.reads = vectors(bits(word, 3, 0), 1) | m;
    result.writes = vectors(bits(word, 15, 12), 1) | d;
  }
  return result;
}

// Table A7-16.
Instruction vfp_data_processing(std::uint32_t word) {
  const bool divides_or_fused = bit(word, 23);
  const std::uint32_t opc1 = bits(word, 21, 20);
  if (divides_or_fused && opc1 == 3) {
    return vfp_unary(word);
  }
  const RegisterSet d = vectors(vfp_number(word, 12, 22), 1);
  Instruction result;
  result.reads = vectors(vfp_number(word, 16, 7), 1) | vectors(vfp_number(word, 0, 5), 1);
  result.writes = d;
  if (divides_or_fused) {
    if (opc1 != 0) {
      return of(Kind::kUnknown);  // fused multiplications of VFPv4: not in a Cortex-A9
    }
    result.kind = by_precision(word, Kind::kVfpDivideSingle, Kind::kVfpDivideDouble);
  } else if (opc1 < 2) {
    result.kind = by_precision(word, Kind::kVfpMultiplyAddSingle, Kind::kVfpMultiplyAddDouble);
    result.reads |= d;
  } else if (opc1 == 2) {
    result.kind = by_precision(word, Kind::kVfpMultiplySingle, Kind::kVfpMultiplyDouble);
  } else {
    result.kind = Kind::kVfpAdd;
  }
  return result;
}

// A7.8: one core register.
Instruction transfer(std::uint32_t word) {
  const bool to_core = bit(word, 20);
  const bool is_scalar = bit(word, 8);
  const unsigned vector = is_scalar ? number(word, 16, 7) : bits(word, 19, 16);
  Instruction result = of(to_core ? Kind::kVectorToCore : Kind::kCoreToVector);
  if (!is_scalar && bits(word, 23, 21) == 7) {  // VMRS, VMSR
    result.kind = to_core ? Kind::kVectorToCore : Kind::kSystem;
    result.reads = register_bit(kVectorFlags);
    const bool flags = bits(word, 15, 12) == kProgramCounter;
    result.writes = flags ? register_bit(kFlags) : field(word, 12);
    return result;
  }
  if (to_core) {
    result.reads = vectors(vector, 1);
    result.writes = field(word, 12);
    return result;
  }
  result.reads = field(word, 12);
  if (is_scalar && bit(word, 23)) {  // VDUP
    result.quad = bit(word, 21);
    result.writes = vectors(vector, result.quad ? 2 : 1);
  } else {
    result.reads |= vectors(vector, 1);  // half of the d register stays
    result.writes = vectors(vector, 1);
  }
  return result;
}

// A7.9: two core registers.
Instruction transfer_two(std::uint32_t word) {
  const bool to_core = bit(word, 20);
  const RegisterSet core = field(word, 12) | field(word, 16);
  const RegisterSet vector =
      bit(word, 8) ? vectors(number(word, 0, 5), 1) : vectors(bits(word, 3, 0), 2);
  Instruction result = of(to_core ? Kind::kVectorToCore : Kind::kCoreToVector);
  result.reads = to_core ? vector : core;
  result.writes = to_core ? core : vector;
  return result;
}

// A7.6: VLDR, VSTR, VLDM, VSTM.
Instruction extension_load_store(std::uint32_t word) {
  if (bits(word, 24, 21) == 2) {
    return transfer_two(word);
  }
  const bool single = bit(word, 24) && !bit(word, 21);
  const unsigned words = single ? (bit(word, 8) ? 2 : 1) : bits(word, 7, 0);
  const unsigned first = vfp_number(word, 12, 22);
  const RegisterSet data = vectors(first, (words + 1) / 2);
  Instruction result = of(bit(word, 20) ? Kind::kVectorLoad : Kind::kVectorStore);
  (bit(word, 20) ? result.writes : result.reads) = data;
  result.address_reads = field(word, 16);
  result.base_writes = bit(word, 21) ? field(word, 16) : 0;
  return result;
}

// Number of d registers of A7.7's multiple-element forms, by type in bits 11 to 8.
unsigned element_registers(std::uint32_t type) {
  switch (type) {
    case 7:
      return 1;
    case 8:
    case 9:
    case 10:
      return 2;
    case 4:
    case 5:
    case 6:
      return 3;
    default:
      return 4;
  }
}

// A7.7: VLD1 to VLD4, VST1 to VST4. Registers two apart are taken for neighbours' superset.
Instruction element_load_store(std::uint32_t word) {
  const bool loads = bit(word, 21);
  const unsigned first = number(word, 12, 22);
  const bool one_lane = bit(word, 23) && bits(word, 11, 10) != 3;
  unsigned count = element_registers(bits(word, 11, 8));
  if (bit(word, 23)) {
    const unsigned structure = bits(word, 9, 8) + 1;
    count = structure == 1 && !one_lane && bit(word, 5) ? 2 : structure;
  }
  Instruction result = of(loads ? Kind::kVectorLoad : Kind::kVectorStore);
  const RegisterSet data = vectors(first, count);
  (loads ? result.writes : result.reads) = data;
  if (loads && one_lane) {
    result.reads = data;
  }
  result.address_reads = field(word, 16);
  const std::uint32_t rm = bits(word, 3, 0);
  if (rm != kProgramCounter) {
    result.base_writes = field(word, 16);
    result.address_reads |= rm == 13 ? 0 : field(word, 0);
  }
  return result;
}

// Table A7-9, by bits 11 to 8 and bit 4.
Kind same_length_kind(std::uint32_t word) {
  const bool odd = bit(word, 4);
  const bool u = bit(word, 24);
  switch (bits(word, 11, 8)) {
    case 1:
      return odd ? Kind::kNeonSimple : Kind::kNeonCompare;
    case 4:
      return odd ? Kind::kNeonSaturatingShift : Kind::kNeonShift;
    case 5:
      return Kind::kNeonSaturatingShift;
    case 7:
      return odd ? Kind::kNeonAccumulate : Kind::kNeonCompare;
    case 8:
      if (odd) {
        return Kind::kNeonCompare;
      }
      return u ? Kind::kNeonShift : Kind::kNeonSimple;  // VSUB reads a stage earlier than VADD
    case 9:
      return odd ? Kind::kNeonMultiply : Kind::kNeonMultiplyAdd;
    case 11:
      return odd ? Kind::kNeonShift : Kind::kNeonMultiply;
    case 12:
      return Kind::kUnknown;  // VFMA: not in a Cortex-A9
    case 13:
      if (!odd) {
        return Kind::kNeonFloatAdd;
      }
      return u ? Kind::kNeonFloatMultiply : Kind::kNeonFloatMultiplyAdd;
    case 14:
      return Kind::kNeonFloatAdd;
    case 15:
      return odd ? Kind::kNeonReciprocalStep : Kind::kNeonFloatAdd;
    default:
      return Kind::kNeonCompare;
  }
}

// Are the old contents of the destination an operand?
bool accumulates(Kind kind) {
  return kind == Kind::kNeonMultiplyAdd || kind == Kind::kNeonFloatMultiplyAdd ||
         kind == Kind::kNeonAccumulate;
}

Instruction neon(Kind kind, RegisterSet destination, RegisterSet operands, bool quad) {
  Instruction result = of(kind);
  result.writes = destination;
  result.reads = operands | (accumulates(kind) ? destination : 0);
  result.quad = quad;
  return result;
}

// Table A7-13: two registers, miscellaneous; group in bits 17 and 16, operation in bits 10 to 7.
Kind two_registers_kind(std::uint32_t word) {
  const std::uint32_t group = bits(word, 17, 16);
  const std::uint32_t operation = bits(word, 10, 7);
  if (group == 0) {
    if (operation < 3) {
      return Kind::kNeonPermute;  // VREV
    }
    return operation == 12 || operation == 13 ? Kind::kNeonAccumulate : Kind::kNeonShift;
  }
  if (group == 1) {
    return bit(word, 10) ? Kind::kNeonFloatAdd : Kind::kNeonCompare;
  }
  if (group == 2) {
    if (operation < 4) {
      return Kind::kNeonPermute;  // VSWP, VTRN, VUZP, VZIP
    }
    return operation == 4 || operation == 6 ? Kind::kNeonShift : Kind::kNeonSaturatingShift;
  }
  return Kind::kNeonFloatAdd;  // VRECPE, VRSQRTE, VCVT
}

Instruction two_registers(std::uint32_t word) {
  const std::uint32_t group = bits(word, 17, 16);
  const std::uint32_t operation = bits(word, 10, 7);
  const bool narrows = group == 2 && (operation == 4 || operation == 5 || operation == 12);
  const bool widens = group == 2 && (operation == 6 || operation == 14);
  const bool quad = bit(word, 6) && !narrows && !widens;
  const RegisterSet d = vectors(number(word, 12, 22), quad || widens ? 2 : 1);
  const RegisterSet m = vectors(number(word, 0, 5), quad || narrows ? 2 : 1);
  Instruction result = neon(two_registers_kind(word), d, m, quad);
  if (group == 2 && operation < 4) {  // both are exchanged
    result.reads = d | m;
    result.writes = d | m;
  }
  return result;
}

// Table A7-12: two registers and a shift amount.
Instruction shift_by_immediate(std::uint32_t word) {
  const std::uint32_t operation = bits(word, 11, 8);
  const bool narrows = operation == 8 || operation == 9;
  const bool widens = operation == 10;
  const bool quad = bit(word, 6) && !narrows && !widens;
  Kind kind = Kind::kNeonShift;
  if (operation == 1 || operation == 3) {
    kind = Kind::kNeonAccumulate;  // VSRA, VRSRA
  } else if (operation == 2 || operation == 6 || operation == 7 || operation == 9 ||
             (operation == 8 && (bit(word, 6) || bit(word, 24)))) {
    kind = Kind::kNeonSaturatingShift;
  } else if (operation >= 14) {
    kind = Kind::kNeonFloatAdd;  // VCVT with a binary point
  }
  const RegisterSet d = vectors(number(word, 12, 22), quad || widens ? 2 : 1);
  Instruction result = neon(kind, d, vectors(number(word, 0, 5), quad || narrows ? 2 : 1), quad);
  const bool inserts = bit(word, 24) && (operation == 4 || operation == 5);  // VSRI, VSLI
  result.reads |= inserts ? d : 0;
  return result;
}

// Table A7-10: three registers of different lengths.
Instruction different_lengths(std::uint32_t word) {
  const std::uint32_t operation = bits(word, 11, 8);
  Kind kind = Kind::kNeonShift;
  if (operation == 5 || operation == 8 || operation == 9 || operation == 10 || operation == 11) {
    kind = operation == 5 ? Kind::kNeonAccumulate : Kind::kNeonMultiplyAdd;
  } else if (operation >= 12) {
    kind = Kind::kNeonMultiply;
  }
  const bool wide_first = operation == 1 || operation == 3 || operation == 4 || operation == 6;
  const bool narrows = operation == 4 || operation == 6;
  const RegisterSet operands = vectors(number(word, 16, 7), wide_first ? 2 : 1) |
                               vectors(number(word, 0, 5), narrows ? 2 : 1);
  return neon(kind, vectors(number(word, 12, 22), narrows ? 1 : 2), operands, false);
}

// Table A7-11: two registers and a scalar.
Instruction by_scalar(std::uint32_t word) {
  const std::uint32_t operation = bits(word, 11, 8);
  const bool is_long = operation == 2 || operation == 3 || operation == 6 || operation == 7 ||
                       operation == 10 || operation == 11;
  const bool quad = bit(word, 24) && !is_long;
  const bool is_float = operation == 1 || operation == 5 || operation == 9;
  const bool multiplies_only = operation >= 8;
  Kind kind = multiplies_only ? Kind::kNeonMultiply : Kind::kNeonMultiplyAdd;
  if (is_float) {
    kind = multiplies_only ? Kind::kNeonFloatMultiply : Kind::kNeonFloatMultiplyAdd;
  }
  const RegisterSet operands =
      vectors(number(word, 16, 7), quad ? 2 : 1) | vectors(bits(word, 3, 0), 1);
  return neon(kind, vectors(number(word, 12, 22), quad || is_long ? 2 : 1), operands, quad);
}

// A7.4: the Advanced SIMD data-processing space.
Instruction simd_data_processing(std::uint32_t word) {
  const unsigned d = number(word, 12, 22);
  const unsigned n = number(word, 16, 7);
  const unsigned m = number(word, 0, 5);
  const bool quad = bit(word, 6);
  const unsigned width = quad ? 2 : 1;
  if (!bit(word, 23)) {
    Instruction result = neon(same_length_kind(word), vectors(d, width),
                              vectors(n, width) | vectors(m, width), quad);
    const bool selects = bits(word, 11, 8) == 1 && bit(word, 4) && bit(word, 24) &&
                         bits(word, 21, 20) != 0;  // VBSL, VBIT, VBIF
    result.reads |= selects ? vectors(d, width) : 0;
    return result;
  }
  if (bit(word, 4)) {
    if (bits(word, 21, 19) == 0 && !bit(word, 7)) {  // one register, modified immediate
      const bool merges = bit(word, 8) && bits(word, 11, 8) < 12;  // VORR, VBIC
      return neon(Kind::kNeonShift, vectors(d, width), merges ? vectors(d, width) : 0, quad);
    }
    return shift_by_immediate(word);
  }
  if (bits(word, 21, 20) != 3) {
    return quad ? by_scalar(word) : different_lengths(word);
  }
  if (!bit(word, 24)) {  // VEXT
    return neon(Kind::kNeonPermute, vectors(d, width), vectors(n, width) | vectors(m, width), quad);
  }
  if (!bit(word, 11)) {
    return two_registers(word);
  }
  if (!bit(word, 10)) {  // VTBL, VTBX
    const unsigned length = bits(word, 9, 8) + 1;
    const RegisterSet kept = quad ? vectors(d, 1) : 0;
    return neon(Kind::kNeonPermute, vectors(d, 1), vectors(n, length) | vectors(m, 1) | kept, true);
  }
  return neon(Kind::kNeonPermute, vectors(d, width), vectors(m, 1), quad);  // VDUP from a scalar
}

}  // namespace

Instruction decode_vector(std::uint32_t word) {
  if (bits(word, 31, 28) == 15) {
    return bits(word, 27, 25) == 1 ? simd_data_processing(word) : element_load_store(word);
  }
  if (bits(word, 27, 25) == 6) {
    return extension_load_store(word);
  }
  return bit(word, 4) ? transfer(word) : vfp_data_processing(word);
}

}  // namespace iog::a9_model
