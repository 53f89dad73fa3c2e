// Symbols of runs as the digits of numbers.
#pragma once

#include <cstdint>
#include <span>

namespace iog::tile_coding {

// Of a run that is as in the reference. Values have the symbols above.
inline constexpr std::uint8_t kLowestSymbol = 1;

// Makes a number of each word, whose bytes are the symbols of four runs, the first the lowest.
// Those less kLowestSymbol, and less one more if they are above the one before, are the digits of
// the number to the base of `alternatives`, the first the highest; before the first symbol is the
// lowest one. Symbols are at most kLowestSymbol + alternatives, and no run has that of the run
// before it; the lowest one may fill up the last word. alternatives: 2 to kMostAlternatives.
// There must be room up to a multiple of four words: what is there may be changed.
void make_numbers(std::span<std::uint32_t> fours, std::uint32_t alternatives);

}  // namespace iog::tile_coding
