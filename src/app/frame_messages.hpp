// What a frame says of itself, as the stream says it.
#pragma once

#include "app/frame_report.hpp"
#include "stream/message.hpp"

namespace iog::app {

// The header of the frame's messages. Their type and number do not matter.
[[nodiscard]] stream::Header header_of(const FrameReport& report);

// Everything but what became of the tiles.
[[nodiscard]] stream::FrameEnd frame_end_of(const FrameReport& report);

}  // namespace iog::app
