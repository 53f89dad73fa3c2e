// What a block of cells finds in the grid is what each of them finds.
#include "window/look_up.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::window {
namespace {

constexpr std::int32_t kOne = 1 << kFineBits;

// A grid with a random index in every cell.
class RandomGrid {
 public:
  explicit RandomGrid(tests::Random& random) {
    std::array<std::int8_t, geometry::kTileCells> tile{};
    for (std::size_t number = 0; number < geometry::kTileCount; ++number) {
      for (std::int8_t& index : tile) {
        index = static_cast<std::int8_t>(random.between(-31, 31));
      }
      cells_->set(number, tile);
      tiles_.push_back(tile);
    }
  }

  [[nodiscard]] const SliceCells& cells() const { return *cells_; }

  [[nodiscard]] std::int8_t at(std::int32_t x, std::int32_t y) const {
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

TEST(LookUp, FindsForABlockWhatEachOfItsCellsFinds) {
  tests::Random random(31);
  const RandomGrid grid(random);
  constexpr auto kCells = static_cast<std::int32_t>(geometry::kCellsPerSide);
  for (int i = 0; i < tests::effort(2000, 300); ++i) {
    const FinePoint step{random.between(-kOne, kOne), random.between(-kOne, kOne)};
    const FinePoint first{random.between(16 * kOne, (kCells - 16) * kOne - 1),
                          random.between(16 * kOne, (kCells - 16) * kOne - 1)};
    const std::size_t column = 8 * random.below(4);
    alignas(8) Band band{};
    band.fill(99);
    look_up_block(grid.cells(), first, step, column, band);
    for (std::int32_t y = 0; y < 8; ++y) {
      for (std::int32_t x = 0; x < 32; ++x) {
        const std::int32_t in_block = x - static_cast<std::int32_t>(column);
        const bool is_inside = in_block >= 0 && in_block < 8;
        const std::int32_t at_x = floored(first.x + in_block * step.x - y * step.y);
        const std::int32_t at_y = floored(first.y + in_block * step.y + y * step.x);
        const int expected = is_inside ? grid.at(at_x, at_y) : 99;
        ASSERT_EQ(band[static_cast<std::size_t>(y * 32 + x)], expected) << x << ' ' << y;
      }
    }
  }
}

}  // namespace
}  // namespace iog::window
