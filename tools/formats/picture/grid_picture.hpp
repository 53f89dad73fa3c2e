// A grid as a picture for people: the cells that are within a radius of the car. The car's x axis
// (forward) points up, and its y axis points left.
#pragma once

#include <algorithm>
#include <string>

#include "tools/formats/picture/canvas.hpp"
#include "tools/frames/grid_frame.hpp"

namespace iog::tools {

struct PictureScale {
  int pixels_per_cell = 1;  // 0: 1 to 8, as many as 1024 pixels hold
  int radius_m = 0;         // from the car to the edges; 0: the whole grid

  [[nodiscard]] int pixels_of_cell(int cells) const {
    return pixels_per_cell > 0 ? pixels_per_cell : std::clamp(1024 / cells, 1, 8);
  }
};

// The colour of a cell. An index between two whole ones is that of a probability between theirs.
[[nodiscard]] Colour colour_of_index(double index);

// "3 of 4 sensors complete, rear partial"
[[nodiscard]] std::string words_of_sensors(const stream::Header& header);

// A hit is at least three pixels wide, and around it covers what is free.
[[nodiscard]] Canvas picture_of(const GridFrame& frame, const PictureScale& scale);

}  // namespace iog::tools
