// Loads and stores of the core registers.
#include "decode_spaces.hpp"

namespace iog::a9_model::spaces {
namespace {

void set_base(Instruction& result, std::uint32_t word, bool writes_back) {
  result.address_reads |= field(word, 16);
  result.base_writes = writes_back ? field(word, 16) : 0;
}

}  // namespace

// A5.2.8 and A5.2.10: LDRH, STRH, LDRSB, LDRSH, LDRD, STRD; exclusives where bits 6 and 5 are 0.
Instruction extra_load_store(std::uint32_t word) {
  const std::uint32_t op2 = bits(word, 6, 5);
  if (op2 == 0) {  // LDREX, STREX and the obsolete SWP
    const bool loads = bit(word, 20);
    const std::uint32_t size = bits(word, 22, 21);
    const bool is_double = size == 1;
    Instruction result = of(loads ? (is_double ? Kind::kLoadMultiple : Kind::kLoad) : Kind::kStore);
    result.address_reads = field(word, 16);
    result.writes = field(word, 12);
    if (loads && is_double) {
      result.writes |= field(word, 12) << 1;
    }
    if (!loads) {
      result.reads = field(word, 0) | (is_double ? field(word, 0) << 1 : 0);
    }
    return bit(word, 23) ? result : of(Kind::kUnknown);
  }
  const bool is_double = !bit(word, 20) && op2 >= 2;
  const bool loads = bit(word, 20) || op2 == 2;
  Instruction result;
  const CoreSet data = field(word, 12) | (is_double ? field(word, 12) << 1 : 0);
  if (loads) {
    result.kind = is_double ? Kind::kLoadMultiple : Kind::kLoadNarrow;
    result.writes = data;
    result.late_result = bit(word, 20) && bit(word, 6);  // LDRSB, LDRSH
  } else {
    result.kind = is_double ? Kind::kStoreMultiple : Kind::kStoreNarrow;
    result.reads = data;
  }
  if (!bit(word, 22)) {
    result.address_reads = field(word, 0);
  }
  set_base(result, word, !bit(word, 24) || bit(word, 21));
  return result;
}

// A5.3: single words and bytes.
Instruction load_store(std::uint32_t word) {
  const bool narrow = bit(word, 22);
  Instruction result;
  if (bit(word, 20)) {
    result.kind = narrow ? Kind::kLoadNarrow : Kind::kLoad;
    result.writes = field(word, 12);
    const bool is_pop = bits(word, 19, 16) == 13 && !bit(word, 24);
    note_jump(result, is_pop);
  } else {
    result.kind = narrow ? Kind::kStoreNarrow : Kind::kStore;
    result.reads = field(word, 12);
  }
  if (bit(word, 25)) {
    result.address_reads = field(word, 0);
    const bool plain = bits(word, 11, 5) == 0;
    const bool lsl_2 = bits(word, 11, 7) == 2 && bits(word, 6, 5) == 0;
    result.scaled_index = !plain && !lsl_2;
  }
  set_base(result, word, !bit(word, 24) || bit(word, 21));
  return result;
}

// A5.5 where bit 25 is 0: LDM and STM. One that loads the program counter from the stack returns.
Instruction load_store_multiple(std::uint32_t word) {
  Instruction result;
  const CoreSet list = bits(word, 15, 0);
  if (bit(word, 20)) {
    result.kind = Kind::kLoadMultiple;
    result.writes = list;
    note_jump(result, bits(word, 19, 16) == 13);
  } else {
    result.kind = Kind::kStoreMultiple;
    result.reads = list;
  }
  set_base(result, word, bit(word, 21));
  return result;
}

}  // namespace iog::a9_model::spaces
