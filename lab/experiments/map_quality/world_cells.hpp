// What is true of the world's cells around the window of a perceived frame, at the frame's end.
#pragma once

#include <vector>

#include "lab/experiments/perception/truth.hpp"
#include "tools/simulate/truth/cell_truth.hpp"

namespace iog::lab {

class WorldCells {
 public:
  explicit WorldCells(const PerceivedFrame& frame);

  // Of the cell of the world that holds a point in the window, or some metres beside it: poses are
  // wrong by centimetres.
  [[nodiscard]] tools::TrueClass at(const LocalToWorld::Point& point) const;

 private:
  tools::CellArea area_;
  std::vector<tools::TrueClass> classes_;
};

}  // namespace iog::lab
