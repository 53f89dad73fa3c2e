// Whether a map agrees with what the sensors see: beams do not pass through houses.
//
// The free cells that count are those that the map has only inside of a building, even after the
// blur: deeper inside than map and poses may be wrong. Simulated drives have none of them with the
// right map or with houses 25 cm off, and up to 8 % with a map that is 7 m off (docs/map.md has the
// figures). Standing cells on roads say nothing, because cars park there.
#pragma once

#include <cstdint>

#include "map/tile_mask.hpp"
#include "window/tile.hpp"

namespace iog::map {

// A round: the frames in which each tile is examined once.
inline constexpr std::uint32_t kRoundFrames = 16;

// The cells that can only be building.
[[nodiscard]] window::Plane inside_buildings(const TileMask& mask);

class Agreement {
 public:
  // One share of free cells contradicts a map, and a much lower one agrees with it.
  static constexpr std::uint32_t kContradictingShare = 256;
  static constexpr std::uint32_t kAgreeingShare = 1'024;
  static constexpr std::uint32_t kFewestFree = 5'000;  // fewer cells are not judged
  static constexpr std::uint32_t kFewestInside = 500;  // 5 m2, a wall that was drawn too far out
  static constexpr std::uint32_t kContradictingRounds = 2;
  static constexpr std::uint32_t kAgreeingRounds = 16;  // 10 s at 25 frames a second

  // Adds a tile's latest state in the round. inside: its inside_buildings().
  void add(const window::Plane& free, const window::Plane& inside);
  void end_round();

  // True from kContradictingRounds contradicting rounds in a row until kAgreeingRounds agreeing
  // ones in a row.
  [[nodiscard]] bool is_contradicted() const { return is_contradicted_; }

 private:
  std::uint32_t free_ = 0;
  std::uint32_t inside_ = 0;
  std::uint32_t rounds_ = 0;  // rounds in a row against is_contradicted_
  bool is_contradicted_ = false;
};

}  // namespace iog::map
