#include "window/standing.hpp"

#include <array>
#include <bit>

#include "window/eight_bytes.hpp"

namespace iog::window {
namespace {

constexpr std::size_t kNear = 2;
constexpr std::uint32_t kInside = ~std::uint32_t{0} << (2 * kNear) >> kNear;

struct RowBits {
  std::uint32_t hit = 0;
  std::uint32_t crossed = 0;
};

RowBits bits_of(const FrameEvidence::TileIndexes& indexes, std::size_t y, bool from_below) {
  RowBits bits;
  for (std::size_t i = 0; i < kGroupsPerRow; ++i) {
    const auto eight = EightBytes::load(&indexes[(y * kGroupsPerRow + i) * evidence::kGroupCells]);
    const std::size_t shift = i * evidence::kGroupCells;
    bits.hit |= std::uint32_t{eight.positive()} << shift;
    const std::uint8_t crossed = from_below ? eight.from_below() : eight.negative();
    bits.crossed |= std::uint32_t{crossed} << shift;
  }
  return bits;
}

// Each bit with two on either side of it.
constexpr std::uint32_t widened(std::uint32_t bits) {
  return bits | bits << 1U | bits << 2U | bits >> 1U | bits >> 2U;
}

}  // namespace

StandingCounts standing_counts(const Tile& tile, const FrameEvidence::TileIndexes& indexes,
                               bool from_below) {
  StandingCounts counts;
  const Plane& stands = tile.found.stands;
  std::uint32_t any = 0;
  for (const std::uint32_t row : stands) {
    any |= row;
  }
  if ((any & kInside) == 0) {
    return counts;
  }
  std::array<RowBits, geometry::kTileSide> rows;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    rows[y] = bits_of(indexes, y, from_below);
  }
  for (std::size_t y = kNear; y < rows.size() - kNear; ++y) {
    const std::uint32_t hit = widened(rows[y - 2].hit | rows[y - 1].hit | rows[y].hit |
                                      rows[y + 1].hit | rows[y + 2].hit);
    const std::uint32_t inside = stands[y] & kInside;
    counts.met += static_cast<std::uint32_t>(std::popcount(inside & hit));
    counts.crossed += static_cast<std::uint32_t>(std::popcount(inside & rows[y].crossed & ~hit));
  }
  return counts;
}

}  // namespace iog::window
