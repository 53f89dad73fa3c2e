// VFP: ARM ARM chapter A7.
#include "decode_spaces.hpp"

namespace iog::a9_model::spaces {
namespace {

// That of an s register: the fifth bit is the lowest.
unsigned single_number(std::uint32_t word, unsigned low, unsigned fifth) {
  return bits(word, low + 3, low) << 1 | (bit(word, fifth) ? 1u : 0u);
}

// The register of a VFP operand; where the three fields are.
VectorSet operand(std::uint32_t word, unsigned low, unsigned fifth, bool is_double) {
  return is_double ? doubles(double_number(word, low, fifth), 1)
                   : singles(single_number(word, low, fifth), 1);
}
VectorSet vfp_d(std::uint32_t word, bool is_double) { return operand(word, 12, 22, is_double); }
VectorSet vfp_n(std::uint32_t word, bool is_double) { return operand(word, 16, 7, is_double); }
VectorSet vfp_m(std::uint32_t word, bool is_double) { return operand(word, 0, 5, is_double); }

Kind by_precision(std::uint32_t word, Kind single, Kind twice) {
  return bit(word, 8) ? twice : single;
}

// Conversions, by the same table: integers are in s registers, and one between the precisions has
// the other one on its other side.
Instruction vfp_conversion(std::uint32_t word, std::uint32_t opc2) {
  const bool is_double = bit(word, 8);
  const bool to_integer = opc2 == 12 || opc2 == 13;
  const bool from_integer = opc2 == 8;
  const bool changes_precision = opc2 == 7;
  Instruction result = of(Kind::kVfpConvert);
  result.vector_reads = vfp_m(word, is_double && !from_integer);
  result.vector_writes = vfp_d(word, is_double != changes_precision && !to_integer);
  return result;
}

// Table A7-17: the operations with one operand.
Instruction vfp_unary(std::uint32_t word) {
  const std::uint32_t opc2 = bits(word, 19, 16);
  const bool is_double = bit(word, 8);
  Instruction result = of(Kind::kVfpMove);
  result.vector_writes = vfp_d(word, is_double);
  if (!bit(word, 6)) {  // VMOV with an immediate
    return result;
  }
  if (opc2 == 4 || opc2 == 5) {
    result.kind = Kind::kVfpCompare;
    result.vector_reads = result.vector_writes | (opc2 == 4 ? vfp_m(word, is_double) : 0);
    result.vector_writes = vector_bit(kVectorFlags);
    return result;
  }
  if (opc2 >= 2) {
    return vfp_conversion(word, opc2);
  }
  result.vector_reads = vfp_m(word, is_double);
  if (opc2 == 1 && bit(word, 7)) {
    result.kind = by_precision(word, Kind::kVfpRootSingle, Kind::kVfpRootDouble);
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
  const bool is_double = bit(word, 8);
  const VectorSet d = vfp_d(word, is_double);
  Instruction result;
  result.vector_reads = vfp_n(word, is_double) | vfp_m(word, is_double);
  result.vector_writes = d;
  if (divides_or_fused) {
    if (opc1 != 0) {
      return of(Kind::kUnknown);  // fused multiplications of VFPv4: not in a Cortex-A9
    }
    result.kind = by_precision(word, Kind::kVfpDivideSingle, Kind::kVfpDivideDouble);
  } else if (opc1 < 2) {
    result.kind = by_precision(word, Kind::kVfpMultiplyAddSingle, Kind::kVfpMultiplyAddDouble);
    result.vector_reads |= d;
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
  Instruction result = of(to_core ? Kind::kVectorToCore : Kind::kCoreToVector);
  if (!is_scalar && bits(word, 23, 21) == 7) {  // VMRS, VMSR
    if (!to_core) {
      result.kind = Kind::kSystem;
      return result;
    }
    const bool flags = bits(word, 15, 12) == kProgramCounter;
    result.vector_reads = vector_bit(kVectorFlags);
    result.writes = flags ? core_bit(kFlags) : field(word, 12);
    return result;
  }
  const VectorSet vector = vfp_n(word, is_scalar);
  if (to_core) {
    result.vector_reads = vector;
    result.writes = field(word, 12);
    return result;
  }
  result.reads = field(word, 12);
  result.vector_writes = vector;
  if (is_scalar && bit(word, 23)) {  // VDUP
    result.quad = bit(word, 21);
    result.vector_writes = doubles(double_number(word, 16, 7), result.quad ? 2 : 1);
  } else if (is_scalar) {
    result.vector_reads = vector;  // the other lanes stay
  }
  return result;
}

// A7.9: two core registers.
Instruction transfer_two(std::uint32_t word) {
  const bool to_core = bit(word, 20);
  const CoreSet core = field(word, 12) | field(word, 16);
  const VectorSet vector = bit(word, 8) ? vfp_m(word, true) : singles(single_number(word, 0, 5), 2);
  Instruction result = of(to_core ? Kind::kVectorToCore : Kind::kCoreToVector);
  (to_core ? result.writes : result.reads) = core;
  (to_core ? result.vector_reads : result.vector_writes) = vector;
  return result;
}

// A7.6: VLDR, VSTR, VLDM, VSTM.
Instruction extension_load_store(std::uint32_t word) {
  if (bits(word, 24, 21) == 2) {
    return transfer_two(word);
  }
  const bool is_double = bit(word, 8);
  const bool one = bit(word, 24) && !bit(word, 21);
  const unsigned words = bits(word, 7, 0);
  VectorSet data = vfp_d(word, is_double);
  if (!one) {
    data = is_double ? doubles(double_number(word, 12, 22), words / 2)
                     : singles(single_number(word, 12, 22), words);
  }
  Instruction result = of(bit(word, 20) ? Kind::kVectorLoad : Kind::kVectorStore);
  (bit(word, 20) ? result.vector_writes : result.vector_reads) = data;
  result.address_reads = field(word, 16);
  result.base_writes = bit(word, 21) ? field(word, 16) : 0;
  return result;
}

}  // namespace

Instruction vfp(std::uint32_t word) {
  if (bits(word, 27, 25) == 6) {
    return extension_load_store(word);
  }
  return bit(word, 4) ? transfer(word) : vfp_data_processing(word);
}

}  // namespace iog::a9_model::spaces
