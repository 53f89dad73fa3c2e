// Detects a map that contradicts the sensors, because beams cannot pass through houses.
//
// Counts free cells deep inside buildings, where only a building is possible even after the blur.
// The blur covers the errors of the map and the poses. In simulated drives, no such cells occur
// with the correct map or with houses that are offset by 25 cm, but up to 8 % occur with a map that
// is offset by 7 m (figures in docs/map.md). Standing cells on roads are not evidence against a
// map, because cars park there.
#pragma once

#include <cstdint>

#include "geometry/grid.hpp"
#include "map/tile_mask.hpp"
#include "window/tile.hpp"

namespace iog::map {

// The number of frames in a round. Each tile is examined once per round.
inline constexpr std::uint32_t kRoundFrames = 16;

// Returns the cells in which only a building is possible.
[[nodiscard]] window::Plane inside_buildings(const TileMask& mask);

class Agreement {
 public:
  // A round contradicts the map if more than 1/kContradictingShare of the free cells are inside
  // buildings. A round agrees with the map if at most 1/kAgreeingShare of the free cells are inside
  // buildings.
  static constexpr std::uint32_t kContradictingShare = 256;
  static constexpr std::uint32_t kAgreeingShare = 1'024;
  // Areas in cells of 0.1 m. A round with fewer than kFewestFree free cells (50 m2) is ignored. The
  // second area (5 m2) is needed because the map may show a wall too far out.
  static constexpr std::uint32_t kFewestFree = 5'000;
  static constexpr std::uint32_t kFewestInside = 500;
  static constexpr std::uint32_t kContradictingRounds = 2;
  static constexpr std::uint32_t kAgreeingRounds = 16;  // 10 s at 25 frames per second

  // Adds the latest state of a tile in this round. `inside` is the result of inside_buildings() for
  // the tile.
  void add(const window::Plane& free, const window::Plane& inside);
  void end_round(std::int32_t cell_mm = geometry::kCellMm);

  // Becomes true after kContradictingRounds contradicting rounds in a row, and becomes false after
  // kAgreeingRounds agreeing rounds in a row.
  [[nodiscard]] bool is_contradicted() const { return is_contradicted_; }

 private:
  std::uint32_t free_ = 0;
  std::uint32_t inside_ = 0;
  std::uint32_t rounds_ = 0;  // consecutive rounds whose result differs from is_contradicted_
  bool is_contradicted_ = false;
};

}  // namespace iog::map
