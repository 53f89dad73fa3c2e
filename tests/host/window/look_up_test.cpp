// What a block of cells finds free in the grid is what each of them finds.
#include "window/look_up.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "window/reach.hpp"

namespace iog::window {
namespace {

constexpr std::int32_t kOne = 1 << kFineBits;

// A grid with a random byte in every cell, but in some of its tiles, of which nothing is known.
class RandomGrid {
 public:
  explicit RandomGrid(tests::Random& random) {
    std::array<std::int8_t, geometry::kTileCells> tile{};
    for (std::size_t number = 0; number < geometry::kTileCount; ++number) {
      Plane bits{};
      tiles_.push_back({});
      if (random.one_in(8)) {
        continue;
      }
      for (std::size_t i = 0; i < tile.size(); ++i) {
        const bool has_bit = random.one_in(3);
        tile[i] = static_cast<std::int8_t>(random.between(-40, 40));
        bits[i / kTileSide] |= (has_bit ? 1U : 0U) << i % kTileSide;
        tiles_.back()[i] = byte_of(tile[i], has_bit);
      }
      cells_->set(number, tile, bits);
    }
  }

  [[nodiscard]] const SliceCells& cells() const { return *cells_; }

  [[nodiscard]] std::int8_t at(std::int32_t x, std::int32_t y) const {
    if (!geometry::kGridArea.contains(geometry::Cell{x, y})) {
      return 0;
    }
    constexpr auto kTiles = static_cast<std::int32_t>(geometry::kTilesPerSide);
    const std::int32_t tile = y / kTileSide * kTiles + x / kTileSide;
    const std::int32_t in_tile = y % kTileSide * kTileSide + x % kTileSide;
    return tiles_[static_cast<std::size_t>(tile)][static_cast<std::size_t>(in_tile)];
  }

 private:
  std::unique_ptr<SliceCells> cells_ = std::make_unique<SliceCells>();
  std::vector<std::array<std::int8_t, geometry::kTileCells>> tiles_;
};

std::int32_t floored(std::int32_t fine) {
  return fine >= 0 ? fine / kOne : -((-fine + kOne - 1) / kOne);
}

// What a beam's index and its bit make of those before (window/slice_byte.hpp).
int expected_of(int before, int found) {
  if (before > 0 || found >= 0) {
    return before;
  }
  const int index = std::min(-before % 32 - found % 32, 31);
  return -(before < -31 || found < -31 ? index + 32 : index);
}

TEST(LookUp, PullsForABlockWhatEachOfItsCellsFinds) {
  tests::Random random(31);
  const RandomGrid grid(random);
  constexpr auto kCells = static_cast<std::int32_t>(geometry::kCellsPerSide);
  for (int i = 0; i < tests::effort(2000, 300); ++i) {
    const double heading = random.between(0, 6'283'185) / 1e6;
    const FinePoint step{static_cast<int>(std::lround(kOne * std::cos(heading))),
                         static_cast<int>(std::lround(kOne * std::sin(heading)))};
    const FinePoint first{random.between(-16 * kOne, (kCells + 16) * kOne - 1),
                          random.between(-16 * kOne, (kCells + 16) * kOne - 1)};
    const std::size_t column = 8 * random.below(4);
    alignas(8) std::array<std::int8_t, 8 * kTileSide> before{};
    std::ranges::generate(before,
                          [&] { return byte_of(random.between(-31, 31), random.one_in(2)); });
    alignas(8) auto evidence = before;
    const Reach reach = Reach::of_square(8, step);
    pull_block(grid.cells(), first, step, reach.low(first), reach.high(first), &evidence[column]);
    for (std::int32_t y = 0; y < 8; ++y) {
      for (std::int32_t x = 0; x < 32; ++x) {
        const std::int32_t in_block = x - static_cast<std::int32_t>(column);
        const bool is_inside = in_block >= 0 && in_block < 8;
        const std::int32_t at_x = floored(first.x + in_block * step.x - y * step.y);
        const std::int32_t at_y = floored(first.y + in_block * step.y + y * step.x);
        const auto at = static_cast<std::size_t>(y * 32 + x);
        const int found = is_inside ? grid.at(at_x, at_y) : 0;
        ASSERT_EQ(evidence[at], expected_of(before[at], found)) << x << ' ' << y;
      }
    }
  }
}

}  // namespace
}  // namespace iog::window
