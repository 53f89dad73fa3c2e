#include "numeric/divisor.hpp"

#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "numeric/reciprocal.hpp"

namespace iog::numeric {
namespace {

// Every divisor up to the length of a line, with the largest and other dividends.
TEST(Divisor, DividesAsTheMachineDoes) {
  tests::Random random(7);
  const auto step = static_cast<std::uint32_t>(tests::effort(1, 97));
  for (std::uint32_t divisor = 1; divisor < (1U << 21); divisor += step) {
    const Divisor by(divisor);
    const std::uint64_t beyond = std::uint64_t{divisor} << 32;
    for (const std::uint64_t dividend : {beyond - 1, beyond - divisor, random.next() % beyond}) {
      ASSERT_EQ(by.divide(dividend), dividend / divisor) << dividend << " / " << divisor;
    }
  }
}

// Divisors of every size, and dividends beside multiples of them.
TEST(Divisor, DividesByAnyWord) {
  tests::Random random(8);
  for (int i = 0; i < tests::effort(2'000'000, 20'000); ++i) {
    const auto divisor =
        static_cast<std::uint32_t>((random.next() >> 32 | 1U << 31) >> random.between(0, 31));
    const std::uint64_t multiple = (random.next() >> 32) * divisor;
    const std::uint64_t dividend = random.one_in(2) || multiple == 0 ? multiple : multiple - 1;
    ASSERT_EQ(Divisor(divisor).divide(dividend), dividend / divisor)
        << dividend << " / " << divisor;
  }
}

TEST(Reciprocal, DividesAsTheMachineDoes) {
  tests::Random random(9);
  for (int i = 0; i < tests::effort(1'000'000, 20'000); ++i) {
    const std::uint32_t divisor =
        static_cast<std::uint32_t>(random.between(1, 0x7FFF'FFFF)) >> random.between(0, 30);
    const std::uint32_t any = static_cast<std::uint32_t>(random.between(0, 0x7FFF'FFFF));
    if (divisor == 0) {
      continue;
    }
    const std::uint32_t dividend = random.one_in(2) ? any : any / divisor * divisor;
    ASSERT_EQ(Reciprocal(divisor).divide(dividend), dividend / divisor)
        << dividend << " / " << divisor;
  }
}

}  // namespace
}  // namespace iog::numeric
