// Shared by the decoders of the core's instructions.
#pragma once

#include "decode.hpp"

namespace iog::a9_model::core {

Instruction data_processing(std::uint32_t word);
Instruction multiply(std::uint32_t word);
Instruction halfword_multiply(std::uint32_t word);
Instruction media(std::uint32_t word);
Instruction load_store(std::uint32_t word);
Instruction extra_load_store(std::uint32_t word);
Instruction load_store_multiple(std::uint32_t word);

// The register whose number is in the four bits from low upwards.
inline RegisterSet field(std::uint32_t word, unsigned low) {
  return register_bit(bits(word, low + 3, low));
}

inline Instruction of(Kind kind) {
  Instruction instruction;
  instruction.kind = kind;
  return instruction;
}

// A result in the program counter is a branch to it. Where the target comes from decides whether
// the return stack predicts it.
inline void note_jump(Instruction& instruction, bool is_return) {
  if ((instruction.writes & register_bit(kProgramCounter)) != 0) {
    instruction.flow = is_return ? Flow::kReturn : Flow::kIndirect;
  }
}

}  // namespace iog::a9_model::core
