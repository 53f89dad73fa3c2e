// What a tile of the window finds free in the grid is what each of its cells finds.
#include "placing/look_up.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "placing/frame_evidence.hpp"
#include "placing/slice.hpp"

namespace iog::placing {
namespace {

constexpr std::int32_t kOne = 1 << kFineBits;

// A grid with a random byte in every cell, but in some of its tiles, of which nothing is known.
class RandomGrid {
 public:
  explicit RandomGrid(tests::Random& random) {
    std::array<std::int8_t, geometry::kTileCells> tile{};
    for (std::size_t number = 0; number < geometry::kTileCount; ++number) {
      window::Plane bits{};
      tiles_.push_back({});
      if (random.one_in(8)) {
        continue;
      }
      for (std::size_t i = 0; i < tile.size(); ++i) {
        const bool has_bit = random.one_in(3);
        tile[i] = static_cast<std::int8_t>(random.between(-40, 40));
        bits[i / window::kTileSide] |= (has_bit ? 1U : 0U) << i % window::kTileSide;
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
    const std::int32_t tile = y / window::kTileSide * kTiles + x / window::kTileSide;
    const std::int32_t in_tile = y % window::kTileSide * window::kTileSide + x % window::kTileSide;
    return tiles_[static_cast<std::size_t>(tile)][static_cast<std::size_t>(in_tile)];
  }

 private:
  std::unique_ptr<SliceCells> cells_ = std::make_unique<SliceCells>();
  std::vector<std::array<std::int8_t, geometry::kTileCells>> tiles_;
};

std::int32_t floored(std::int32_t fine) {
  return fine >= 0 ? fine / kOne : -((-fine + kOne - 1) / kOne);
}

// What a beam's index and its bit make of those before (placing/slice_byte.hpp).
int expected_of(int before, int found) {
  if (before > 0 || found >= 0) {
    return before;
  }
  const int index = std::min(-before % 32 - found % 32, 31);
  return -(before < -31 || found < -31 ? index + 32 : index);
}

TEST(LookUp, PullsForATileWhatEachOfItsCellsFinds) {
  tests::Random random(31);
  const RandomGrid grid(random);
  constexpr auto kCells = static_cast<std::int32_t>(geometry::kCellsPerSide);
  int tiles_of_nothing = 0;
  for (int i = 0; i < tests::effort(400, 60); ++i) {
    // Along the axes and the diagonals, near them, and anywhere.
    const double heading =
        random.one_in(2) ? random.between(0, 6'283'185) / 1e6
                         : random.between(0, 8) * 0.785398163397448 + random.between(-3, 3) / 1e3;
    const FinePoint step{static_cast<int>(std::lround(kOne * std::cos(heading))),
                         static_cast<int>(std::lround(kOne * std::sin(heading)))};
    const FinePoint first{random.between(-48 * kOne, (kCells + 48) * kOne - 1),
                          random.between(-48 * kOne, (kCells + 48) * kOne - 1)};
    alignas(32) std::array<std::int8_t, geometry::kTileCells> before{};
    std::ranges::generate(before,
                          [&] { return byte_of(random.between(-31, 31), random.one_in(2)); });
    alignas(32) auto evidence = before;
    const bool is_any = pull_tile(grid.cells(), first, EightSteps(step), evidence);
    tiles_of_nothing += is_any ? 0 : 1;
    for (std::int32_t y = 0; y < 32; ++y) {
      for (std::int32_t x = 0; x < 32; ++x) {
        const std::int32_t at_x = floored(first.x + x * step.x - y * step.y);
        const std::int32_t at_y = floored(first.y + x * step.y + y * step.x);
        const auto at = static_cast<std::size_t>(y * 32 + x);
        const int found = grid.at(at_x, at_y);
        ASSERT_EQ(evidence[at], expected_of(before[at], found)) << heading << ' ' << x << ' ' << y;
        ASSERT_TRUE(is_any || found == 0);
      }
    }
  }
  EXPECT_GT(tiles_of_nothing, 0);
}

// A slice in a grid that is long ahead of the car, and wide to its left, is what it is in the usual
// one. Tiles of the one are tiles of the other.
TEST(LookUp, NoShapeOfTheGridShows) {
  constexpr window::Area kArea({-16, -16});
  tests::Random random(11);
  for (const geometry::Grid& grid :
       {geometry::Grid{.columns = 2048, .rows = 512, .origin_column = 256, .origin_row = 192},
        geometry::Grid{.columns = 512, .rows = 2048, .origin_column = 320, .origin_row = 1600}}) {
    const auto cells = std::make_unique<SliceCells>();
    cells->take_shape(grid);
    const auto found = std::make_unique<FrameEvidence>();
    const auto expected = std::make_unique<FrameEvidence>();
    for (int time = 0; time < tests::effort(12, 3); ++time) {
      tests::Slice slice;
      for (int i = 0; i < 3'000; ++i) {
        const geometry::Cell cell{geometry::kOriginCell + random.between(-150, 150),
                                  geometry::kOriginCell + random.between(-150, 150)};
        slice.set(cell, random.one_in(9) ? 2 : -14);
      }
      Placement at = tests::placed(random.between(-5'000, 5'000), random.between(-5'000, 5'000),
                                   random.between(0, 359));
      const auto usual = std::make_unique<SliceCells>();
      slice.release([&](std::size_t tile, auto indexes, const window::Plane& low_and_tall) {
        const geometry::Cell place{
            static_cast<std::int32_t>(tile % 32) - 16 + grid.origin_column / 32,
            static_cast<std::int32_t>(tile / 32) - 16 + grid.origin_row / 32};
        usual->set(tile, indexes, low_and_tall);
        cells->set(static_cast<std::size_t>(place.y * grid.columns / 32 + place.x), indexes,
                   low_and_tall);
      });
      expected->add(*usual, kArea, at);
      at.grid = grid;
      found->add(*cells, kArea, at);
      cells->clear();
    }
    std::size_t hit = 0;
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      ASSERT_EQ(found->is_touched(slot), expected->is_touched(slot));
      ASSERT_TRUE(!found->is_touched(slot) || found->tile(slot) == expected->tile(slot)) << slot;
      hit += found->has_hit(slot) ? 1U : 0U;
    }
    EXPECT_GT(hit, 20U);
  }
}

}  // namespace
}  // namespace iog::placing
