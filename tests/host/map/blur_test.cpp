// The union over a disc, against a loop over all cells near by.
#include "map/blur.hpp"

#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "map/flat_map.hpp"

namespace iog::map {
namespace {

bool has_within(const FrameBits& bits, std::int32_t column, std::int32_t row, std::int32_t radius) {
  for (std::int32_t y = 0; y < kFrameSide; ++y) {
    for (std::int32_t x = 0; x < kFrameSide; ++x) {
      const std::int32_t dx = x - column;
      const std::int32_t dy = y - row;
      if (dx * dx + dy * dy <= radius * radius && has(bits, x, y)) {
        return true;
      }
    }
  }
  return false;
}

void expect_blurred(const FrameBits& bits, std::int32_t radius) {
  const window::Plane plane = blurred(bits, radius);
  for (std::int32_t y = 0; y < window::kTileSide; ++y) {
    for (std::int32_t x = 0; x < window::kTileSide; ++x) {
      ASSERT_EQ((plane[static_cast<std::size_t>(y)] >> x & 1) != 0,
                has_within(bits, x + kHalo, y + kHalo, radius))
          << radius << ' ' << x << ' ' << y;
    }
  }
}

// Few cells, so that discs show.
FrameBits cells(tests::Random& random, int number) {
  FrameBits bits;
  for (int i = 0; i < number; ++i) {
    bits.rows[random.below(kFrameSide)] |= std::uint64_t{1} << random.below(kFrameSide);
  }
  return bits;
}

TEST(Blur, ACellHasWhatAnyCellWithinTheRadiusHas) {
  tests::Random random(1);
  for (std::int32_t radius = 0; radius <= kHalo; ++radius) {
    for (const int number : {1, 2, 5, 40}) {
      for (int i = 0; i < tests::effort(3, 1); ++i) {
        expect_blurred(cells(random, number), radius);
      }
    }
  }
}

TEST(Blur, NothingStaysNothingAndAllStaysAll) {
  FrameBits none;
  FrameBits all;
  all.rows.fill(~std::uint64_t{0});
  for (std::int32_t radius = 0; radius <= kHalo; ++radius) {
    for (std::size_t y = 0; y < window::kTileSide; ++y) {
      ASSERT_EQ(blurred(none, radius)[y], 0U);
      ASSERT_EQ(blurred(all, radius)[y], ~0U);
    }
  }
}

// What lies beyond the rows of the radius is not looked at.
TEST(Blur, AllButOneCellIsNotAll) {
  for (std::int32_t radius = 0; radius <= kHalo; ++radius) {
    FrameBits bits;
    bits.rows.fill(~std::uint64_t{0});
    bits.rows[20] = ~(std::uint64_t{1} << 30);
    expect_blurred(bits, radius);
  }
}

}  // namespace
}  // namespace iog::map
