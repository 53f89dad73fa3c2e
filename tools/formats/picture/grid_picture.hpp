// A grid as a picture for people, with the car in the middle, its x axis (forward) pointing up and
// its y axis pointing left. If the grid does not surround the car, the middle of the grid is in the
// middle.
#pragma once

#include <cstdint>
#include <string>

#include "tools/formats/picture/canvas.hpp"
#include "tools/frames/grid_frame.hpp"

namespace iog::tools {

struct PictureScale {
  int pixels_per_cell = 1;
  int radius_m = 51;  // from the car to the edges; 51: the whole grid
};

// The colour of a cell. An index between two whole ones is that of a probability between theirs.
[[nodiscard]] Colour colour_of_index(double index);

// "3 of 4 sensors complete, rear partial"
[[nodiscard]] std::string words_of_sensors(const stream::Header& header);

// A hit is at least three pixels wide, and around it covers what is free.
[[nodiscard]] Canvas picture_of(const GridFrame& frame, const PictureScale& scale);

}  // namespace iog::tools
