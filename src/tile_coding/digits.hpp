// Combines the symbols of runs into large numbers.
#pragma once

#include <cstdint>
#include <span>

namespace iog::tile_coding {

// The symbol of a run that equals the reference tile. The symbols of values are greater than this
// symbol.
inline constexpr std::uint8_t kLowestSymbol = 1;

// Converts each word in place. A word contains the symbols of four runs, with the first run in the
// lowest byte. The result is the number formed by their digits. The digit of a run is its symbol
// minus kLowestSymbol. It is one less if the symbol is greater than the symbol of the previous run.
// The digits are in base `alternatives`, most significant digit first. The first run is encoded as
// if kLowestSymbol preceded it.
//
// Symbols must not exceed kLowestSymbol + alternatives, and adjacent runs must have different
// symbols. The last word may be padded with kLowestSymbol. alternatives: 2 to kMostAlternatives.
// The size of the buffer must be a multiple of four words. Words after the span may be overwritten.
void make_numbers(std::span<std::uint32_t> fours, std::uint32_t alternatives);

}  // namespace iog::tile_coding
