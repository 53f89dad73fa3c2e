// Stores the exit range of each layer in each sector. The exit range of a beam is the distance over
// which the beam stays between two height limits above the ground. A beam frees cells only up to
// its exit range (docs/ground.md, "What is freed").
//
// A beam that starts between the limits can leave at either one: at the lower limit, it comes too
// close to the ground, and at the upper limit, it rises too high above the ground. Of two beams
// that cross the lower limit, the one with the higher slope crosses it farther from the sensor.
// Of two beams that cross the upper limit, the one with the higher slope crosses it nearer to
// the sensor. One outward sweep per limit is therefore enough to find the exit ranges of all layers
// of a sector. Each sweep produces a sorted list. For level sensors, the two lists are merged to
// sort the layers by exit range.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ground/bins.hpp"
#include "ground/fan.hpp"
#include "ground/judge.hpp"
#include "ground/surface.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::ground {

class Exits {
 public:
  // Finds the exit ranges of a sector's beams. The fan must be turned to this sector. If the sensor
  // is outside of the limits, all exit ranges are 0.
  void find(std::uint32_t sector, const Fan& fan, Limits limits, const Surface& surface);

  // Returns the exit range of a beam, as a distance along the beam's line. The distance is rounded
  // down to a multiple of 2 mm and is at most the line's length.
  [[nodiscard]] std::uint32_t to_mm(std::uint32_t sector, std::size_t layer) const {
    return std::uint32_t{2} * rows_[sector][layer].to_2_mm;
  }
  // Returns the layer that has the given rank in a sector. Layers are ranked by descending exit
  // range. Ranks are valid only for level sensors.
  [[nodiscard]] std::size_t by_rank(std::uint32_t sector, std::size_t rank) const {
    return rows_[sector][rank].of_rank;
  }
  // Returns a layer's rank. Rank 0 has the farthest exit.
  [[nodiscard]] std::uint32_t rank_of(std::uint32_t sector, std::size_t layer) const {
    return rows_[sector][layer].rank;
  }

 private:
  // Entry i stores the exit range of layer i next to the layer's rank, because both are read for
  // every return. Entry i also stores the layer that has rank i.
  struct Exit {
    std::uint16_t to_2_mm = 0;
    std::uint8_t rank = 0;
    std::uint8_t of_rank = 0;
  };
  using Row = std::array<Exit, vehicle::kMaxLayers>;

  std::array<Row, kSectors> rows_{};
};

}  // namespace iog::ground
