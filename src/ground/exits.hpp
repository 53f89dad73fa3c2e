// How far a beam of each layer stays between the two limits over the ground, sector by sector: the
// part of a line that it can free (docs/ground.md, "What is freed").
//
// A beam that starts between the limits leaves them where the ground comes too near, or where it
// gets too high over the ground. Of those that leave below, one that looks up more leaves later; of
// those that leave above, sooner. So one look outward is enough for all layers of a sector, and a
// second one for the other side; and to put layers in the order in which they leave, two sorted
// lists are merged.
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
  // Of a level sensor, whose lines are at most 131,070 mm long.
  void find(const Beams& beams, Limits limits, const Surface& surface);

  // So far along its line a beam is between the limits from its start on, in steps of 2 mm, rounded
  // down; at most the line's length.
  [[nodiscard]] std::uint32_t to_mm(std::uint32_t sector, std::size_t layer) const {
    return std::uint32_t{2} * rows_[sector].to_2_mm[layer];
  }
  // The layers of a sector, that which is between the limits farthest first.
  [[nodiscard]] std::size_t by_rank(std::uint32_t sector, std::size_t rank) const {
    return rows_[sector].by_rank[rank];
  }
  [[nodiscard]] std::uint32_t rank_of(std::uint32_t sector, std::size_t layer) const {
    return rows_[sector].rank_of[layer];
  }

 private:
  struct Row {
    std::array<std::uint16_t, vehicle::kMaxLayers> to_2_mm{};
    std::array<std::uint8_t, vehicle::kMaxLayers> by_rank{};
    std::array<std::uint8_t, vehicle::kMaxLayers> rank_of{};
  };

  std::array<Row, kSectors> rows_{};
};

}  // namespace iog::ground
