#include "fusion/joined_grid.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "lanes/bring.hpp"
#include "lanes/lanes.hpp"

namespace iog::fusion {
namespace {

using index::OccupancyIndex;

// The number of bytes by which preloads run ahead.
constexpr std::size_t kAhead = 4 * lanes::kLineBytes;

std::uint32_t hits_of(const OccupancyIndex* row) {
  std::uint32_t hits = 0;
  for (std::size_t x = 0; x < geometry::kTileSide; ++x) {
    hits |= (row[x] > 0 ? 1U : 0U) << x;
  }
  return hits;
}

}  // namespace

// Joins sixteen cells at a time. The machine saturates at 127 and -128, and -128 is raised to -127.
// Sums of indexes of both signs are meaningless; where a cell is hit, they are not used.
void join(std::span<OccupancyIndex, geometry::kTileCells> to, JoinedGrid::TileIndexes more) {
  static_assert(index::kIndexMax<OccupancyIndex> == 127);
  const grid::Lanes unknown = grid::Lanes::all(index::kUnknown);
  const grid::Lanes least = grid::Lanes::all(index::kIndexMin<OccupancyIndex>);
  for (std::size_t i = 0; i < to.size(); i += grid::kLaneCount) {
    if (i % lanes::kLineBytes == 0) {
      lanes::preload(&more[i], kAhead);
      lanes::preload(&to[i], kAhead);
    }
    const grid::Lanes one = grid::Lanes::load_bytes(&to[i]);
    const grid::Lanes other = grid::Lanes::load_bytes(&more[i]);
    const grid::Lanes hit = one.max(unknown).add(other.max(unknown));
    const grid::Lanes free = one.add(other).max(least);
    hit.bit_or(free.and_not(hit.above_zero())).store_bytes(&to[i]);
  }
}

grid::TileBits join(JoinedGrid::TileIndexes one, const grid::TileBits& bits_of_one,
                    JoinedGrid::TileIndexes other, const grid::TileBits& bits_of_other) {
  grid::TileBits bits{};
  for (std::size_t y = 0; y < bits.size(); ++y) {
    if ((bits_of_one[y] | bits_of_other[y]) != 0) {
      const std::uint32_t in_one = hits_of(&one[y * geometry::kTileSide]);
      const std::uint32_t in_other = hits_of(&other[y * geometry::kTileSide]);
      const std::uint32_t in_none = ~(in_one | in_other);
      bits[y] = (bits_of_one[y] & (in_one | in_none)) | (bits_of_other[y] & (in_other | in_none));
    }
  }
  return bits;
}

void JoinedGrid::add(std::size_t tile, TileIndexes indexes) {
  auto& cells = tiles_[tile];
  if (!is_known_[tile]) {
    is_known_[tile] = true;
    std::ranges::copy(indexes, cells.begin());
    return;
  }
  join(cells, indexes);
}

}  // namespace iog::fusion
