// The instruction spaces that decode() chooses from, one or two to a file, and what they share.
#pragma once

#include "decode.hpp"

namespace iog::a9_model::spaces {

Instruction data_processing(std::uint32_t word);
Instruction multiply(std::uint32_t word);
Instruction halfword_multiply(std::uint32_t word);
Instruction media(std::uint32_t word);
Instruction load_store(std::uint32_t word);
Instruction extra_load_store(std::uint32_t word);
Instruction load_store_multiple(std::uint32_t word);
Instruction vfp(std::uint32_t word);
Instruction simd(std::uint32_t word);

// The register whose number is in the four bits from low upwards.
inline CoreSet field(std::uint32_t word, unsigned low) {
  return core_bit(bits(word, low + 3, low));
}

inline Instruction of(Kind kind) {
  Instruction instruction;
  instruction.kind = kind;
  return instruction;
}

// A result in the program counter is a branch to it. Where the target comes from decides whether
// the return stack predicts it.
inline void note_jump(Instruction& instruction, bool is_return) {
  if ((instruction.writes & core_bit(kProgramCounter)) != 0) {
    instruction.flow = is_return ? Flow::kReturn : Flow::kIndirect;
  }
}

// The number of a d register: four bits from low upwards and the fifth, upper one.
inline unsigned double_number(std::uint32_t word, unsigned low, unsigned fifth) {
  return bits(word, low + 3, low) | (bit(word, fifth) ? 16u : 0u);
}

}  // namespace iog::a9_model::spaces
