// Eight bits are enough on the way, so that sixteen cells are joined at once: with indexes in
// -127 ... 127, the room that one leaves to +-127 is 0 ... 127, and what is added is cut to it.
#include "grid/joined_grid.hpp"

#include <algorithm>
#include <cstdint>

namespace iog::grid {
namespace {

using index::OccupancyIndex;

constexpr OccupancyIndex kMost = index::kIndexMax<OccupancyIndex>;
constexpr OccupancyIndex kLeast = index::kIndexMin<OccupancyIndex>;

constexpr OccupancyIndex above(OccupancyIndex index) { return std::max(index, index::kUnknown); }
constexpr OccupancyIndex below(OccupancyIndex index) { return std::min(index, index::kUnknown); }

constexpr OccupancyIndex joined(OccupancyIndex a, OccupancyIndex b) {
  const auto room_above = static_cast<OccupancyIndex>(kMost - above(a));
  const auto room_below = static_cast<OccupancyIndex>(kLeast - below(a));
  const auto hit = static_cast<OccupancyIndex>(above(a) + std::min(above(b), room_above));
  const auto free = static_cast<OccupancyIndex>(below(a) + std::max(below(b), room_below));
  return hit > 0 ? hit : free;
}

std::uint32_t hits_of(const OccupancyIndex* row) {
  std::uint32_t hits = 0;
  for (std::size_t x = 0; x < geometry::kTileSide; ++x) {
    hits |= (row[x] > 0 ? 1U : 0U) << x;
  }
  return hits;
}

}  // namespace

void join(std::span<OccupancyIndex, geometry::kTileCells> to, JoinedGrid::TileIndexes more) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    to[i] = joined(to[i], more[i]);
  }
}

TileBits join(JoinedGrid::TileIndexes one, const TileBits& bits_of_one,
              JoinedGrid::TileIndexes other, const TileBits& bits_of_other) {
  TileBits bits{};
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

}  // namespace iog::grid
