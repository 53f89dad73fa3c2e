// Combines the symbols of runs into numbers.
#pragma once

#include <cstdint>
#include <span>

namespace iog::tile_coding {

// The symbol of a run that equals the reference. The symbols of values are above it.
inline constexpr std::uint8_t kLowestSymbol = 1;

// Replaces each word, whose bytes are the symbols of four runs (the first in the lowest byte), by
// the number with the digits of these runs. The digit of a run is its symbol minus kLowestSymbol,
// minus one more if the symbol is above that of the previous run. Digits are to the base
// `alternatives`, most significant first. Before the first run, the previous symbol is
// kLowestSymbol.
//
// Symbols are at most kLowestSymbol + alternatives, and no run has the symbol of the previous run.
// kLowestSymbol may pad the last word. alternatives: 2 to kMostAlternatives. The buffer must extend
// to a multiple of four words; the words after the span may be overwritten.
void make_numbers(std::span<std::uint32_t> fours, std::uint32_t alternatives);

}  // namespace iog::tile_coding
