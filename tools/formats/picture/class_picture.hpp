// A class grid as a picture for people: the local frame, x to the right and y up, with the car
// where it was.
#pragma once

#include <cstdint>

#include "decision/decision.hpp"
#include "tools/formats/picture/canvas.hpp"
#include "tools/formats/picture/frame_title.hpp"
#include "tools/formats/picture/grid_picture.hpp"
#include "tools/frames/class_grid.hpp"

namespace iog::tools {

// The colour of a class byte (decision/decision.hpp): the surer, the stronger.
[[nodiscard]] Colour colour_of_class(std::int8_t byte);

// What a class is called in the legend.
[[nodiscard]] const char* name_of_class(decision::Class what);

// The picture shows all of the window or scale.radius_m around the car, or around the window's
// middle if no slice of the frame has a place. A cell that is occupied is at least three pixels
// wide, and what moves lies over what stands. The car has the outline of its description, or is an
// arrow of 4 m if nobody here knows it. A bar has the length that stands beside it.
[[nodiscard]] Canvas picture_of(const ClassGrid& classes, const FrameTitle& title,
                                const PictureScale& scale);

}  // namespace iog::tools
