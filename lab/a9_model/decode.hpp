// A32 words to Instruction, by capstone's disassembly of them.
//
// Every word has an answer; what capstone or kinds.cpp does not know is Kind::kUnknown.
#pragma once

#include <cstdint>

#include "instruction.hpp"

namespace iog::a9_model {

// Of one thread.
Instruction decode(std::uint32_t word);

}  // namespace iog::a9_model
