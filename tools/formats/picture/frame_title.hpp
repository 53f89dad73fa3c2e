// What stands above every picture of a frame.
#pragma once

#include <cstdint>
#include <string>

#include "tools/frames/grid_frame.hpp"

namespace iog::tools {

struct FrameTitle {
  std::uint64_t number = 0;      // among the frames with evidence
  std::uint64_t closed_us = 0;   // when the frame closed, by the target's clock
  std::uint32_t vehicle_id = 0;  // of the car that the stream names
};

[[nodiscard]] FrameTitle title_of(const GridFrame& frame);

// "frame 50, 2.071 s, reference_car"; without a name if nobody here knows the car.
[[nodiscard]] std::string words_of(const FrameTitle& title);

}  // namespace iog::tools
