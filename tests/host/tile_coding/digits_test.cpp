// Symbols of runs become numbers, as docs/spec.md 3.4 tells: on the target this is the twin.
#include "tile_coding/digits.hpp"

#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/random.hpp"
#include "tile_coding/symbol_packing.hpp"

namespace iog::tile_coding {
namespace {

// Of symbols from 0; the lowest one fills up the last word.
std::vector<std::uint32_t> fours_of(const std::vector<std::uint32_t>& symbols) {
  std::vector<std::uint32_t> fours((symbols.size() + 3) / 4);
  for (std::size_t i = 0; i < 4 * fours.size(); ++i) {
    const std::uint32_t symbol = i < symbols.size() ? symbols.at(i) : 0;
    fours.at(i / 4) |= (symbol + kLowestSymbol) << (8 * (i % 4));
  }
  return fours;
}

// Of symbols from 0, one by one: the digits, then their value.
std::vector<std::uint32_t> numbers_by_the_rule(const std::vector<std::uint32_t>& symbols,
                                               std::uint32_t base) {
  std::vector<std::uint32_t> digits;
  std::uint32_t before = 0;
  for (const std::uint32_t symbol : symbols) {
    digits.push_back(symbol > before ? symbol - 1 : symbol);
    before = symbol;
  }
  digits.resize((digits.size() + 3) / 4 * 4);
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = 0; i < digits.size(); i += 4) {
    numbers.push_back(digits.at(i) * base * base * base + digits.at(i + 1) * base * base +
                      digits.at(i + 2) * base + digits.at(i + 3));
  }
  return numbers;
}

// A buffer of its own keeps what is changed behind the last word.
std::vector<std::uint32_t> numbers_made(std::vector<std::uint32_t> fours, std::uint32_t base) {
  const std::size_t count = fours.size();
  fours.resize(count + 3);
  make_numbers(std::span(fours).first(count), base);
  fours.resize(count);
  return fours;
}

// By hand: symbols 2, 1, 0, 3 after a 0 are the digits 1, 1, 0, 2 to base 3.
TEST(Digits, AreSymbolsWithoutTheOneBefore) {
  EXPECT_EQ(numbers_made(fours_of({2, 1, 0, 3}), 3),
            std::vector<std::uint32_t>{1 * 27 + 1 * 9 + 0 * 3 + 2});
}

TEST(Digits, AreTheLargestNumbersAtTheMostAlternatives) {
  const std::uint32_t n = kMostAlternatives;
  EXPECT_EQ(numbers_made(fours_of({n, n - 1, n, n - 1}), n),
            std::vector<std::uint32_t>{((214U * 215 + 214) * 215 + 214) * 215 + 214});
}

TEST(Digits, OfAnySymbolsAreThoseOfTheRule) {
  tests::Random random(20263);
  for (std::uint32_t n = 2; n <= kMostAlternatives; ++n) {
    for (std::size_t count = 1; count <= 40; ++count) {
      std::vector<std::uint32_t> symbols;
      for (std::uint32_t before = 0; symbols.size() < count; before = symbols.back()) {
        const auto digit = static_cast<std::uint32_t>(random.between(0, static_cast<int>(n) - 1));
        symbols.push_back(digit + (digit >= before ? 1 : 0));
      }
      ASSERT_EQ(numbers_made(fours_of(symbols), n), numbers_by_the_rule(symbols, n))
          << n << ' ' << count;
    }
  }
}

}  // namespace
}  // namespace iog::tile_coding
