// What a frame does to eight cells: they age, take in evidence, and are decided.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ageing/clock.hpp"
#include "evidence/assignment.hpp"
#include "window/tile.hpp"

namespace iog::window {

// Evidence that is so many frames old is long ago. Every group is looked at often enough to find it
// so before the clock's slot is used again, and what is 100 ms old counts as long ago anyway:
// frames are 4 ms apart or more.
inline constexpr unsigned kLongAgoFrames = 32;

// The evidence of a group in the frame that ended now.
struct GroupEvidence {
  evidence::Indexes indexes{};
  std::uint8_t moved = 0;  // bit i is of cell i
};

// The group has evidence. Without an assignment all hits have one mass.
void fuse_group(Tile& tile, std::size_t group, const GroupEvidence& what,
                const ageing::Clock& clock, const evidence::Assignment* assignment);

// The group has none. False if nothing is known of it, and so nothing was to do.
bool refresh_group(Tile& tile, std::size_t group, const ageing::Clock& clock);

}  // namespace iog::window
