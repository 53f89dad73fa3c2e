// Combines the symbols of several runs into one large number.
#pragma once

#include <cstdint>
#include <span>

namespace iog::tile_coding {

// The symbol of a run that equals the reference tile. The symbols of all values are greater than
// kLowestSymbol.
inline constexpr std::uint8_t kLowestSymbol = 1;

// Converts each word in place. A word contains the symbols of four runs, with the first run in the
// lowest byte. The result is a number whose digits represent the four runs. The digit of a run is
// its symbol minus kLowestSymbol, or one less if its symbol is greater than that of the previous
// run. The digits are in base `alternatives`, with the most significant digit first. The first run
// is encoded as if a run with kLowestSymbol came before it.
//
// Symbols must not exceed kLowestSymbol + alternatives, and adjacent runs must have different
// symbols. The last word may be padded with kLowestSymbol. `alternatives` must be between 2 and
// kMostAlternatives. The buffer size must be a multiple of four words. Words after the span may be
// overwritten.
void make_numbers(std::span<std::uint32_t> fours, std::uint32_t alternatives);

}  // namespace iog::tile_coding
