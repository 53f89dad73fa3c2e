// Combines the symbols of runs into numbers.
#pragma once

#include <cstdint>
#include <span>

namespace iog::tile_coding {

// The symbol of a run that equals the reference. The symbols of values are above it.
inline constexpr std::uint8_t kLowestSymbol = 1;

// Converts each word in place. A word holds the symbols of four runs, the first in the lowest byte;
// the result is the number made of their digits. The digit of a run is its symbol minus
// kLowestSymbol, minus one more if the symbol is above that of the previous run. Digits are to the
// base `alternatives`, most significant first. The symbol before the first run is kLowestSymbol.
//
// Symbols are at most kLowestSymbol + alternatives, and adjacent runs have different symbols.
// kLowestSymbol may pad the last word. alternatives: 2 to kMostAlternatives. The buffer must extend
// to a multiple of four words; words after the span may be overwritten.
void make_numbers(std::span<std::uint32_t> fours, std::uint32_t alternatives);

}  // namespace iog::tile_coding
