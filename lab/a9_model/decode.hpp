// A32 words to Instruction, by the ARM Architecture Reference Manual (ARM DDI 0406), chapter A5 for
// the core, A7 for VFP and Advanced SIMD.
//
// Every word has an answer; what is not known is Kind::kUnknown. Encodings that the manual calls
// unpredictable may be taken for their predictable neighbours.
#pragma once

#include <cstdint>

#include "instruction.hpp"

namespace iog::a9_model {

Instruction decode(std::uint32_t word);

constexpr std::uint32_t bits(std::uint32_t word, unsigned high, unsigned low) {
  return (word >> low) & ((2u << (high - low)) - 1);
}
constexpr bool bit(std::uint32_t word, unsigned index) { return ((word >> index) & 1u) != 0; }

}  // namespace iog::a9_model
