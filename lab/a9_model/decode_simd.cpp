// Advanced SIMD: ARM ARM sections A7.4 and A7.7.
#include "decode_spaces.hpp"

namespace iog::a9_model::spaces {
namespace {

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
  const unsigned first = double_number(word, 12, 22);
  const bool one_lane = bit(word, 23) && bits(word, 11, 10) != 3;
  unsigned count = element_registers(bits(word, 11, 8));
  if (bit(word, 23)) {
    const unsigned structure = bits(word, 9, 8) + 1;
    count = structure == 1 && !one_lane && bit(word, 5) ? 2 : structure;
  }
  Instruction result = of(loads ? Kind::kVectorLoad : Kind::kVectorStore);
  const VectorSet data = doubles(first, count);
  (loads ? result.vector_writes : result.vector_reads) = data;
  if (loads && one_lane) {
    result.vector_reads = data;
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

Instruction simd_operation(Kind kind, VectorSet destination, VectorSet operands, bool quad) {
  Instruction result = of(kind);
  result.vector_writes = destination;
  result.vector_reads = operands | (accumulates(kind) ? destination : 0);
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
  const VectorSet d = doubles(double_number(word, 12, 22), quad || widens ? 2 : 1);
  const VectorSet m = doubles(double_number(word, 0, 5), quad || narrows ? 2 : 1);
  Instruction result = simd_operation(two_registers_kind(word), d, m, quad);
  if (group == 2 && operation < 4) {  // both are exchanged
    result.vector_reads = d | m;
    result.vector_writes = d | m;
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
  const VectorSet d = doubles(double_number(word, 12, 22), quad || widens ? 2 : 1);
  Instruction result =
      simd_operation(kind, d, doubles(double_number(word, 0, 5), quad || narrows ? 2 : 1), quad);
  const bool inserts = bit(word, 24) && (operation == 4 || operation == 5);  // VSRI, VSLI
  result.vector_reads |= inserts ? d : 0;
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
  const VectorSet operands = doubles(double_number(word, 16, 7), wide_first ? 2 : 1) |
                             doubles(double_number(word, 0, 5), narrows ? 2 : 1);
  return simd_operation(kind, doubles(double_number(word, 12, 22), narrows ? 1 : 2), operands,
                        false);
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
  const bool halfwords = bits(word, 21, 20) == 1;
  const VectorSet operands = doubles(double_number(word, 16, 7), quad ? 2 : 1) |
                             doubles(halfwords ? bits(word, 2, 0) : bits(word, 3, 0), 1);
  return simd_operation(kind, doubles(double_number(word, 12, 22), quad || is_long ? 2 : 1),
                        operands, quad);
}

// A7.4: the Advanced SIMD data-processing space.
Instruction simd_data_processing(std::uint32_t word) {
  const unsigned d = double_number(word, 12, 22);
  const unsigned n = double_number(word, 16, 7);
  const unsigned m = double_number(word, 0, 5);
  const bool quad = bit(word, 6);
  const unsigned width = quad ? 2 : 1;
  if (!bit(word, 23)) {
    Instruction result = simd_operation(same_length_kind(word), doubles(d, width),
                                        doubles(n, width) | doubles(m, width), quad);
    const bool selects = bits(word, 11, 8) == 1 && bit(word, 4) && bit(word, 24) &&
                         bits(word, 21, 20) != 0;  // VBSL, VBIT, VBIF
    result.vector_reads |= selects ? doubles(d, width) : 0;
    return result;
  }
  if (bit(word, 4)) {
    if (bits(word, 21, 19) == 0 && !bit(word, 7)) {  // one register, modified immediate
      const bool merges = bit(word, 8) && bits(word, 11, 8) < 12;  // VORR, VBIC
      return simd_operation(Kind::kNeonShift, doubles(d, width), merges ? doubles(d, width) : 0,
                            quad);
    }
    return shift_by_immediate(word);
  }
  if (bits(word, 21, 20) != 3) {
    return quad ? by_scalar(word) : different_lengths(word);
  }
  if (!bit(word, 24)) {  // VEXT
    return simd_operation(Kind::kNeonPermute, doubles(d, width),
                          doubles(n, width) | doubles(m, width), quad);
  }
  if (!bit(word, 11)) {
    return two_registers(word);
  }
  if (!bit(word, 10)) {  // VTBL, VTBX
    const unsigned length = bits(word, 9, 8) + 1;
    const VectorSet kept = quad ? doubles(d, 1) : 0;
    return simd_operation(Kind::kNeonPermute, doubles(d, 1),
                          doubles(n, length) | doubles(m, 1) | kept, true);
  }
  return simd_operation(Kind::kNeonPermute, doubles(d, width), doubles(m, 1),
                        quad);  // VDUP from a scalar
}

}  // namespace

Instruction simd(std::uint32_t word) {
  return bits(word, 27, 25) == 1 ? simd_data_processing(word) : element_load_store(word);
}

}  // namespace iog::a9_model::spaces
