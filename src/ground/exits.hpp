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
    return std::uint32_t{2} * rows_[sector][layer].to_2_mm;
  }
  // The layers of a sector, that which is between the limits farthest first.
  [[nodiscard]] std::size_t by_rank(std::uint32_t sector, std::size_t rank) const {
    return rows_[sector][rank].of_rank;
  }
  [[nodiscard]] std::uint32_t rank_of(std::uint32_t sector, std::size_t layer) const {
    return rows_[sector][layer].rank;
  }

 private:
  // Of the layer of a number how far it gets and its rank, which a return asks for together; and
  // the layer of the rank of that number.
  struct Exit {
    std::uint16_t to_2_mm = 0;
    std::uint8_t rank = 0;
    std::uint8_t of_rank = 0;
  };
  using Row = std::array<Exit, vehicle::kMaxLayers>;

  std::array<Row, kSectors> rows_{};
};

}  // namespace iog::ground
