// How far a rectangle's image reaches: as far as its cells, and no further.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "fakes/random.hpp"
#include "placing/placement.hpp"

namespace iog::placing {
namespace {

using geometry::Cell;

TEST(Reach, IsThatOfAllCellsOfTheRectangle) {
  tests::Random random(20);
  constexpr double kCell = 1 << kFineBits;
  for (int degrees = 0; degrees < 360; degrees += 3) {
    const double angle = degrees * std::numbers::pi / 180;
    const FinePoint step{static_cast<std::int32_t>(std::llround(std::cos(angle) * kCell)),
                         static_cast<std::int32_t>(std::llround(std::sin(angle) * kCell))};
    const FinePoint first{random.between(-(1 << 28), 1 << 28), random.between(-(1 << 28), 1 << 28)};
    const std::int32_t columns = random.between(1, 32);
    const std::int32_t rows = random.between(1, 32);
    Cell low = first.cell();
    Cell high = low;
    FinePoint row = first;
    for (std::int32_t y = 0; y < rows; ++y, row = along_y(row, step)) {
      FinePoint at = row;
      for (std::int32_t x = 0; x < columns; ++x, at = along_x(at, step)) {
        low = {std::min(low.x, at.cell().x), std::min(low.y, at.cell().y)};
        high = {std::max(high.x, at.cell().x), std::max(high.y, at.cell().y)};
      }
    }
    const Reach reach = Reach::of(columns, rows, step);
    EXPECT_EQ(reach.low(first), low) << degrees;
    EXPECT_EQ(reach.high(first), high) << degrees;
    EXPECT_EQ(Reach::of_square(rows, step).high(first), Reach::of(rows, rows, step).high(first));
  }
}

}  // namespace
}  // namespace iog::placing
