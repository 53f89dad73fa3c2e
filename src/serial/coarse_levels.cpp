#include "serial/coarse_levels.hpp"

#include <algorithm>

namespace iog::serial {
namespace {

constexpr std::size_t kSide = tile_coding::kTileSide;
constexpr std::size_t kFineSide = std::size_t{1} << CoarseLevels::kFineLevel;  // cells
constexpr std::size_t kFinePerTile = kSide / kFineSide;                        // along a side
constexpr std::size_t kFinePerRough = std::size_t{1}
                                      << (CoarseLevels::kRoughLevel - CoarseLevels::kFineLevel);
static_assert(kFinePerTile >= 1, "a tile has at least one fine cell");
static_assert(geometry::kTilesPerSide * kFinePerTile == CoarseLevels::kFineTilesPerSide * kSide);

// The loops work on local arrays so that compilers vectorise them.
template <std::size_t kCount>
using Indexes = std::array<std::int8_t, kCount>;

std::int8_t index_of(std::byte cell) { return static_cast<std::int8_t>(cell); }

// The highest index in each column of a fine cell's rows. A fine cell has at least four rows.
void copy_highest_of_columns(const std::byte* rows, std::int8_t* highest) {
  for (std::size_t x = 0; x < kSide; ++x) {
    highest[x] = std::max(index_of(rows[x]), index_of(rows[kSide + x]));
  }
  for (std::size_t y = 2; y < kFineSide; ++y) {
    for (std::size_t x = 0; x < kSide; ++x) {
      highest[x] = std::max(highest[x], index_of(rows[y * kSide + x]));
    }
  }
}

template <std::size_t kCount>
Indexes<kCount / 2> highest_of_pairs(const Indexes<kCount>& in) {
  Indexes<kCount / 2> out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = std::max(in[2 * i], in[2 * i + 1]);
  }
  return out;
}

// The highest index of each kFineSide neighbours in rows of kSide cells.
template <std::size_t kWidth, std::size_t kCount>
auto highest_of_neighbours(const Indexes<kCount>& in) {
  if constexpr (kWidth == 1) {
    return in;
  } else {
    return highest_of_neighbours<kWidth / 2>(highest_of_pairs(in));
  }
}

}  // namespace

void CoarseLevels::clear() {
  for (Tile& tile : fine_) {
    tile.fill(0);
  }
  known_fine_tiles_ = 0;
}

void CoarseLevels::add_tile(std::size_t tile, tile_coding::TileCells cells) {
  // The fine cell at the tile's corner, in coordinates of the fine grid.
  const std::size_t fine_x = tile % geometry::kTilesPerSide * kFinePerTile;
  const std::size_t fine_y = tile / geometry::kTilesPerSide * kFinePerTile;
  const std::size_t fine_tile = fine_y / kSide * kFineTilesPerSide + fine_x / kSide;
  Indexes<kFinePerTile * kSide> columns;
  for (std::size_t y = 0; y < kFinePerTile; ++y) {
    copy_highest_of_columns(&cells[y * kFineSide * kSide], &columns[y * kSide]);
  }
  // All rows of the tile's fine cells at once, which fills the registers.
  const auto fine = highest_of_neighbours<kFineSide>(columns);
  std::int8_t* out = &fine_[fine_tile][fine_y % kSide * kSide + fine_x % kSide];
  for (std::size_t y = 0; y < kFinePerTile; ++y, out += kSide) {
    std::copy_n(&fine[y * kFinePerTile], kFinePerTile, out);
  }
  known_fine_tiles_ |= 1U << fine_tile;
}

void CoarseLevels::copy_rough(tile_coding::MutableTileCells rough) const {
  for (std::size_t i = 0; i < rough.size(); ++i) {
    const std::size_t fine_x = i % kSide * kFinePerRough;
    const std::size_t fine_y = i / kSide * kFinePerRough;
    const Tile& tile = fine_[fine_y / kSide * kFineTilesPerSide + fine_x / kSide];
    const std::int8_t* row = &tile[fine_y % kSide * kSide + fine_x % kSide];
    std::int8_t highest = *row;
    for (std::size_t y = 0; y < kFinePerRough; ++y, row += kSide) {
      highest = std::max(highest, *std::max_element(row, row + kFinePerRough));
    }
    rough[i] = static_cast<std::byte>(highest);
  }
}

}  // namespace iog::serial
