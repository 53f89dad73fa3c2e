// Implements free-space gating. Only low beams make a cell eligible for motion detection.
//
// A beam frees every cell that it crosses within the height band. Some of these cells are above a
// bonnet, a verge or a kerb. Others are reached through the windows of a parked car. If a later
// beam hits such a cell, the hit is at a different height, and nothing has moved. The car file
// therefore specifies two heights for each sensor: the maximum height of a beam that opens cells
// (low_mm), and the minimum height of a return from a moving object (tall_mm). The following rules
// apply:
//
//   * A hit can indicate motion only on ground that a low beam has already freed, and only near a
//     tall return (arrivals.hpp).
//   * If a sensor is high enough to see over objects, only low beams can free occupied cells. Other
//     beams have no effect on these cells.
//   * A cell becomes open ground or dense ground only if a low beam has freed it.
//
// Tile::from_below stores whether a low beam has freed a cell. The bit is set when a low beam frees
// the cell, and cleared when a standing object is hit there. All conditions refer to the state
// before the frame and are evaluated as set operations, so the order of slices, tiles and cores
// does not matter.
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

  // The functions below are the steps for one slot. The steps may be repeated, and may run for
  // several slots concurrently. For a slot with evidence, call find() before changing any tile.
  // `bits` contains the slot's evidence.
  void find(const window::Window& window, const placing::EvidenceBits& bits, std::size_t slot);
  // Call leave_out_high() before the evidence is fused into the tile.
  void leave_out_high(placing::FrameEvidence& evidence, std::size_t slot) const;
  // Call remember() after the evidence has been fused into the tile or the tile has been refreshed.
  // The tile must be known.
  void remember(window::Tile& tile, bool is_touched, std::size_t slot) const;

 private:
  bool looks_over_things_;
  std::array<window::Plane, window::kSlotCount>
      high_{};  // occupied, and crossed only by beams that are not low there
  std::array<window::Plane, window::kSlotCount> next_{};  // Tile::from_below after the frame
};

}  // namespace iog::perception
