// Exit ranges of each sector and layer: how far a beam stays between the two height limits over the
// ground. A beam can free cells only up to its exit (docs/ground.md, "What is freed").
//
// A beam that starts between the limits leaves them either below, where the ground comes too near,
// or above, where the beam is too high over the ground. Among beams that leave below, one that
// points higher leaves later. Among beams that leave above, one that points higher leaves sooner.
// So one sweep outward on each side finds the exits of all layers of a sector. Each sweep gives a
// sorted list, and merging the two lists orders the layers by exit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ground/beams.hpp"
#include "ground/bins.hpp"
#include "ground/judge.hpp"
#include "ground/surface.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::ground {

class Exits {
 public:
  // For a level sensor whose lines are at most 131,070 mm long.
  void find(const Beams& beams, Limits limits, const Surface& surface);

  // The exit of a beam: the distance along its line at which it leaves the limits. It is in steps
  // of 2 mm, rounded down, and at most the line's length.
  [[nodiscard]] std::uint32_t to_mm(std::uint32_t sector, std::size_t layer) const {
    return std::uint32_t{2} * rows_[sector][layer].to_2_mm;
  }
  // The layers of a sector, farthest exit first.
  [[nodiscard]] std::size_t by_rank(std::uint32_t sector, std::size_t rank) const {
    return rows_[sector][rank].of_rank;
  }
  [[nodiscard]] std::uint32_t rank_of(std::uint32_t sector, std::size_t layer) const {
    return rows_[sector][layer].rank;
  }

 private:
  // Entry i holds the exit and the rank of layer i, because a return needs both. It also holds the
  // layer with rank i.
  struct Exit {
    std::uint16_t to_2_mm = 0;
    std::uint8_t rank = 0;
    std::uint8_t of_rank = 0;
  };
  using Row = std::array<Exit, vehicle::kMaxLayers>;

  std::array<Row, kSectors> rows_{};
};

}  // namespace iog::ground
