// Processes symbols one by one. This is the specification; digits_neon.cpp is its Cortex-A9 twin.
#include "tile_coding/digits.hpp"

namespace iog::tile_coding {

void make_numbers(std::span<std::uint32_t> fours, std::uint32_t alternatives) {
  std::uint32_t before = kLowestSymbol;
  for (std::uint32_t& four : fours) {
    std::uint32_t number = 0;
    for (unsigned i = 0; i < 4; ++i) {
      const std::uint32_t symbol = four >> (8 * i) & 0xFFU;
      number = number * alternatives + symbol - kLowestSymbol - (symbol > before ? 1 : 0);
      before = symbol;
    }
    four = number;
  }
}

}  // namespace iog::tile_coding
