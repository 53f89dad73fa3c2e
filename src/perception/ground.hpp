// What is remembered of the ground after a frame, from what was found in it.
//
// Beside what stands (3 by 3) nothing is remembered. Elsewhere a cell becomes dense if all 5 by 5
// are seen, and open if all 7 by 7 are shut. Shut is what is freed, with gaps of up to four cells
// between beams closed (dilated by 5 by 5, then eroded by 5 by 5), and not taken. What is found
// open again in another period of 480 ms is known better: ticks, at most 3. No cell outside of the
// window is shut; only what is dilated reaches there.
#pragma once

#include <cstddef>

#include "window/window.hpp"

namespace iog::perception {

// Remembers the tile at a slot, of which something is known. `is_new_period`: a period has begun
// since the slot's turn before.
void remember(window::Window& window, std::size_t slot, bool is_new_period);

}  // namespace iog::perception
