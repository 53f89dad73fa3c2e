// Only low beams open ground.
//
// A beam frees every cell that it crosses in the height band. That includes cells above a bonnet, a
// verge or a kerb, and cells seen through the windows of a parked car. If the next beam hits there,
// it is at another height, and nothing has moved. So the car file says for each sensor how low a
// beam must be to open ground (low_mm) and how tall a moving object is (tall_mm). Then:
//
//   1. A hit can show motion only on ground that a low beam has freed before, near a tall hit
//      (arrivals.hpp).
//   2. If sensors look over objects, only low beams can free occupied cells. Other beams have no
//      effect on such a cell.
//   3. Ground becomes open and dense only where a low beam has freed it.
//
// Tile::from_below holds this bit: set where a low beam frees the cell, cleared where a standing
// object is hit. All conditions refer to the state before the frame and are set operations, so the
// order of slices, tiles and cores does not matter.
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

  // The steps for one slot. They may be repeated, and may run for several slots at once. Call
  // find() before any tile changes, for a slot with evidence. `bits` are those of its evidence.
  void find(const window::Window& window, const placing::EvidenceBits& bits, std::size_t slot);
  // Call before the tile takes in the evidence.
  void leave_out_high(placing::FrameEvidence& evidence, std::size_t slot) const;
  // Call after the tile has taken in the evidence or was refreshed. The tile must be known.
  void remember(window::Tile& tile, bool is_touched, std::size_t slot) const;

 private:
  bool looks_over_things_;
  std::array<window::Plane, window::kSlotCount>
      high_{};  // occupied, and crossed only by beams that are not low
  std::array<window::Plane, window::kSlotCount> next_{};  // Tile::from_below after the frame
};

}  // namespace iog::perception
