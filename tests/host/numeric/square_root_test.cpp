#include "numeric/square_root.hpp"

#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::numeric {
namespace {

// root^2 <= square < (root + 1)^2, the definition.
void expect_root(std::uint64_t square) {
  const std::uint64_t root = square_root(square);
  ASSERT_LE(root * root, square);
  if (root < 0xFFFF'FFFF) {
    ASSERT_GT((root + 1) * (root + 1), square);
  }
}

TEST(SquareRoot, OfSmallNumbers) {
  for (std::uint64_t square = 0; square < 70'000; ++square) {
    expect_root(square);
  }
}

TEST(SquareRoot, BesideSquaresOfEverySize) {
  tests::Random random(3);
  for (int i = 0; i < tests::effort(300'000, 3'000); ++i) {
    const std::uint64_t root = random.next() >> random.between(32, 63);
    expect_root(root * root);
    expect_root(root * root + random.next() % (2 * root + 1));
    expect_root(root == 0 ? 0 : root * root - 1);
  }
  expect_root(~std::uint64_t{0});
}

}  // namespace
}  // namespace iog::numeric
