// Detects a map that contradicts the sensors: beams do not pass through houses.
//
// Counts free cells deep inside buildings. Only a building is possible there even after the blur,
// which covers the errors of map and poses. In simulated drives there are none with the right map
// or with houses 25 cm off, and up to 8 % with a map that is 7 m off (docs/map.md has the figures).
// Standing cells on roads are no evidence, because cars park there.
#pragma once

#include <cstdint>

#include "map/tile_mask.hpp"
#include "window/tile.hpp"

namespace iog::map {

// A round is the number of frames in which each tile is examined once.
inline constexpr std::uint32_t kRoundFrames = 16;

// The cells that can only be building.
[[nodiscard]] window::Plane inside_buildings(const TileMask& mask);

class Agreement {
 public:
  // A round contradicts the map if more than 1/kContradictingShare of the free cells are inside
  // buildings. A round agrees with it if at most 1/kAgreeingShare of them are.
  static constexpr std::uint32_t kContradictingShare = 256;
  static constexpr std::uint32_t kAgreeingShare = 1'024;
  static constexpr std::uint32_t kFewestFree = 5'000;  // rounds with fewer cells are not judged
  // 5 m2, because a wall may be drawn too far out.
  static constexpr std::uint32_t kFewestInside = 500;
  static constexpr std::uint32_t kContradictingRounds = 2;
  static constexpr std::uint32_t kAgreeingRounds = 16;  // 10 s at 25 frames a second

  // Adds the latest state of a tile in this round. inside: inside_buildings() of the tile.
  void add(const window::Plane& free, const window::Plane& inside);
  void end_round();

  // Becomes true after kContradictingRounds contradicting rounds in a row, and false after
  // kAgreeingRounds agreeing ones in a row.
  [[nodiscard]] bool is_contradicted() const { return is_contradicted_; }

 private:
  std::uint32_t free_ = 0;
  std::uint32_t inside_ = 0;
  std::uint32_t rounds_ = 0;  // rounds in a row against is_contradicted_
  bool is_contradicted_ = false;
};

}  // namespace iog::map
