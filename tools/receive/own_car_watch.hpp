// Whether the sensors see the car itself: a footprint that is too small leaves hits on it, which
// seem to move with the car.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pose/pose.hpp"
#include "tools/frames/grid_frame.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

class OwnCarWatch {
 public:
  // The car outlives it.
  explicit OwnCarWatch(const CatalogueEntry& car) : body_(&car.description->footprint) {}

  // Frames in their order; those without indexes or a pose, or near the one before, change nothing.
  void add(const GridFrame& frame);

  // A row of a table: where hits stayed beside the footprint while the car drove 20 m, and nothing
  // stayed that is larger, such as a wall along the way. Empty if there are none.
  [[nodiscard]] std::string row_of_footprint() const;

 private:
  const description::FootprintConfig* body_;
  geometry::Grid grid_{};
  struct Cell {
    std::uint32_t frames = 0;  // in which it or a neighbour was hit
    std::uint32_t last_frame = 0;
  };
  std::vector<Cell> cells_;
  std::uint32_t frames_ = 0;
  pose::Pose last_{};
};

}  // namespace iog::tools
