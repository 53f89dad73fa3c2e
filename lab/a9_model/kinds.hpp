// Which kind a disassembled instruction is of: capstone's mnemonics, kind by kind.
#pragma once

#include <array>
#include <bitset>
#include <capstone/capstone.h>
#include <cstdint>
#include <string_view>

#include "instruction.hpp"

namespace iog::a9_model {

// Instructions by their mnemonics, which stand beside one another with a space between them;
// std::invalid_argument if capstone does not know one.
class Mnemonics {
 public:
  Mnemonics(csh capstone, std::string_view names);
  [[nodiscard]] bool has(const cs_insn& insn) const { return ids_[insn.id]; }
  [[nodiscard]] bool has(unsigned id) const { return ids_[id]; }

 private:
  std::bitset<ARM_INS_ENDING> ids_;
};

// What happens to an operand, or to the only one, before it is used.
enum class Shift : std::uint8_t { kNone, kByConstant, kByRegister };
[[nodiscard]] Shift shift_of(const cs_insn& insn);

class Kinds {
 public:
  explicit Kinds(csh capstone);

  // By the tables of the TRM and the NEON MPE TRM. An instruction that a Cortex-A9 does not have,
  // or that is in none of the tables, is kUnknown.
  [[nodiscard]] Kind of(const cs_insn& insn) const;

 private:
  using Table = std::array<Kind, ARM_INS_ENDING>;

  [[nodiscard]] Kind of_simd(const cs_insn& insn) const;
  [[nodiscard]] Kind of_core(const cs_insn& insn) const;

  Table all_{};      // of the core, memory, and Advanced SIMD on integers
  Table floats_{};   // of Advanced SIMD on floating point
  Table singles_{};  // of VFP
  Table doubles_{};
};

}  // namespace iog::a9_model
