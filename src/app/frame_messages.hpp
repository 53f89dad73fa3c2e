// What a frame says of itself, as the stream says it.
#pragma once

#include "app/frame_report.hpp"
#include "stream/message.hpp"

namespace iog::app {

// The header of the frame's messages. Their type and number do not matter.
[[nodiscard]] stream::Header header_of(const FrameReport& report);

// Everything but what became of the tiles. It is long, and not to be on the stack twice.
void set_frame_end(const FrameReport& report, stream::FrameEnd& end);

}  // namespace iog::app
