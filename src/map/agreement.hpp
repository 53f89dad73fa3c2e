// Detects maps that contradict the sensors. Beams cannot pass through houses, so free cells inside
// buildings indicate a wrong map.
//
// The detector counts free cells deep inside buildings. The only possible class of these cells is
// `building`, even after the map has been blurred. The blur is wide enough to cover the errors of
// both the map and the poses. In simulated drives, no free cells are inside buildings, even if the
// map's houses are offset by 25 cm. If the map is offset by 7 m, up to 8 % of the free cells are
// inside buildings (see docs/map.md). Standing cells on roads are not evidence against a map,
// because cars park on roads.
#pragma once

#include <cstdint>

#include "geometry/grid.hpp"
#include "map/tile_mask.hpp"
#include "window/tile.hpp"

namespace iog::map {

// The number of frames per round. Each tile is examined once per round.
inline constexpr std::uint32_t kRoundFrames = 16;

// Returns the cells whose only possible class is `building`.
[[nodiscard]] window::Plane inside_buildings(const TileMask& mask);

class Agreement {
 public:
  // A round contradicts the map if more than 1/kContradictingShare of the free cells are inside
  // buildings. A round agrees with the map if at most 1/kAgreeingShare of the free cells are inside
  // buildings.
  static constexpr std::uint32_t kContradictingShare = 256;
  static constexpr std::uint32_t kAgreeingShare = 1'024;
  // These minimum areas are specified in cells of 0.1 m x 0.1 m. A round with fewer than
  // kFewestFree free cells (50 m2) is ignored. A round contradicts the map only if at least
  // kFewestInside free cells (5 m2) are inside buildings, because a building may be larger on the
  // map than in reality.
  static constexpr std::uint32_t kFewestFree = 5'000;
  static constexpr std::uint32_t kFewestInside = 500;
  static constexpr std::uint32_t kContradictingRounds = 2;
  static constexpr std::uint32_t kAgreeingRounds = 16;  // 10 s at 25 frames per second

  // Adds the free cells of a tile to the counts of this round. `inside` is the result of
  // inside_buildings() for the tile.
  void add(const window::Plane& free, const window::Plane& inside);
  void end_round(std::int32_t cell_mm = geometry::kCellMm);

  // Returns true after kContradictingRounds consecutive contradicting rounds, and false again after
  // kAgreeingRounds consecutive agreeing rounds.
  [[nodiscard]] bool is_contradicted() const { return is_contradicted_; }

 private:
  std::uint32_t free_ = 0;
  std::uint32_t inside_ = 0;
  std::uint32_t rounds_ = 0;  // consecutive rounds whose result differs from is_contradicted_
  bool is_contradicted_ = false;
};

}  // namespace iog::map
