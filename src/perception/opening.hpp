// Ground is opened only from below.
//
// A beam frees every cell that it crosses in the height band, also one above a bonnet, a verge or a
// kerb, and one that it crosses through the windows of a parked car. That the next beam hits there
// is no motion but another height. So a car's description says for each sensor how low a beam has
// to be to open ground, low_mm, and how tall something is that moves, tall_mm. Then:
//
//   1. a hit arrives only on ground that a low beam has freed before, beside a tall hit
//   (arrivals.hpp);
//   2. if sensors look over things, what is taken gives way only to low beams: for others
//   the frame says nothing of the cell;
//   3. ground becomes open and dense only where a low beam has freed it.
//
// Tile::from_below remembers it: set where a low beam frees the cell, cleared where something that
// stands is hit. All of it is asked of the state before the frame, and is made of sets, so that no
// order of slices, tiles or cores shows.
#pragma once

#include <array>
#include <cstddef>

#include "perception/rules.hpp"
#include "placing/evidence_bits.hpp"
#include "placing/frame_evidence.hpp"
#include "window/window.hpp"

namespace iog::perception {

class Opening {
 public:
  explicit Opening(const Rules& rules = {}) : looks_over_things_(rules.looks_over_things) {}

  // Its steps by slot. Each may be done again, and for several slots at once.
  // Of a slot with evidence, which has these bits, before any tile is changed.
  void find(const window::Window& window, const placing::EvidenceBits& bits, std::size_t slot);
  // Before the tile takes in the evidence.
  void leave_out_high(placing::FrameEvidence& evidence, std::size_t slot) const;
  // When the tile has taken in the evidence, or was refreshed. It is known.
  void remember(window::Tile& tile, bool is_touched, std::size_t slot) const;

 private:
  bool looks_over_things_;
  std::array<window::Plane, window::kSlotCount>
      high_{};  // taken, and free by beams that are not low
  std::array<window::Plane, window::kSlotCount> next_{};  // Tile::from_below after the frame
};

}  // namespace iog::perception
