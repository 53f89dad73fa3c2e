// What a frame says of its place, as the stream says it.
#pragma once

#include "app/perception_report.hpp"
#include "stream/class_end.hpp"
#include "stream/class_window.hpp"
#include "stream/map_state.hpp"
#include "window/area.hpp"

namespace iog::app {

// corner: of the window. Where no slice was placed, its slices begin and end at the frame's stamp.
[[nodiscard]] stream::ClassWindow class_window_of(const PerceptionReport& report,
                                                  window::TileNumber corner);

// What it says of the map.
[[nodiscard]] stream::MapState map_state_of(const PerceptionReport& report);

// Everything but what became of the tiles.
[[nodiscard]] stream::ClassEnd class_end_of(const PerceptionReport& report,
                                            const stream::ClassWindow& window);

}  // namespace iog::app
