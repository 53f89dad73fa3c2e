// Whether a map agrees with what the sensors see: beams do not pass through houses.
//
// Of the cells that are free those count that the map has inside of a building and nothing else,
// even after the blur: farther inside than the map and the poses may be wrong. Simulated drives
// have none of them with the right map, and none with houses 25 cm off; with a map that is 7 m off
// up to 8 % (docs/map.md has the figures). Cells that stand on roads tell nothing: cars park there.
#pragma once

#include <cstdint>

#include "map/tile_mask.hpp"
#include "window/tile.hpp"

namespace iog::map {

// Each tile is looked at once in so many frames: a round.
inline constexpr std::uint32_t kRoundFrames = 16;

// The cells that can be nothing but building.
[[nodiscard]] window::Plane inside_buildings(const TileMask& mask);

class Agreement {
 public:
  // One share of free cells contradicts a map, and a much lower one agrees with it.
  static constexpr std::uint32_t kContradictingShare = 256;
  static constexpr std::uint32_t kAgreeingShare = 1'024;
  static constexpr std::uint32_t kFewestFree = 5'000;  // of fewer cells nothing is said
  static constexpr std::uint32_t kFewestInside = 500;  // 5 m2, a wall that was drawn too far out
  static constexpr std::uint32_t kContradictingRounds = 2;
  static constexpr std::uint32_t kAgreeingRounds = 16;  // 10 s at 25 frames a second

  // A tile in a round, as it was found last. inside: inside_buildings() of it.
  void add(const window::Plane& free, const window::Plane& inside);
  void end_round();

  // Since kContradictingRounds in a row contradicted, until kAgreeingRounds in a row agreed.
  [[nodiscard]] bool is_contradicted() const { return is_contradicted_; }

 private:
  std::uint32_t free_ = 0;
  std::uint32_t inside_ = 0;
  std::uint32_t rounds_ = 0;  // in a row that speak against is_contradicted_
  bool is_contradicted_ = false;
};

}  // namespace iog::map
