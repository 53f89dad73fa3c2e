// Which hits of a frame are on something that moved there, and which on the flickering edges of
// what stands.
//
// Where ground is opened only from below (perception/opening.hpp), a hit counts only if its cell
// was, and if one of the hits at most Rules::tall_within away is tall: what lies so low that beams
// go over it does not move.
//
// All of it is asked of the state before the frame. A hit is *beside* if one of the 3 by 3 cells
// stands. It is *new* if its cell is open, freed, and it is not beside. It has moved if it is not
// beside and its cell is dense, or open with enough new hits in the 7 by 7: two where the ground
// was found open three times, else seven.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "perception/rules.hpp"
#include "placing/frame_evidence.hpp"
#include "window/window.hpp"

namespace iog::perception {

class Arrivals {
 public:
  explicit Arrivals(const Rules& rules = {})
      : is_from_below_(rules.is_opened_from_below), tall_within_(rules.tall_within) {}

  // Of all hits of a frame, before any tile is changed.
  void find(const window::Window& window, const placing::FrameEvidence& evidence);

  // Its steps: begin(), then two by slot. `hits` are those of the tile's evidence. The second is
  // asked when the first has been of every slot that is touched, and before the tile at the slot is
  // changed. Each of the two may be done again, and for several slots at once.
  void begin() {
    has_new_.fill(false);
    has_open_.fill(false);
  }
  void find_new(const window::Window& window, const placing::FrameEvidence& evidence,
                std::size_t slot, const window::Plane& hits);
  void find_none(std::size_t slot) { moved_[slot] = {}; }  // of a slot without hits
  void find_moved(const window::Window& window, std::size_t slot) {
    if (has_open_[slot]) {
      count_new(window, slot);
    }
  }

  // The hits in the tile at this slot that have moved.
  [[nodiscard]] const window::Plane& moved(std::size_t slot) const { return moved_[slot]; }

 private:
  void count_new(const window::Window& window, std::size_t slot);

  bool is_from_below_;
  int tall_within_;
  // Of a tile without new hits, or without open ones, what is stored is of an older frame.
  std::array<bool, window::kSlotCount> has_new_{};
  std::array<bool, window::kSlotCount> has_open_{};
  std::array<window::Plane, window::kSlotCount> new_{};
  std::array<window::Plane, window::kSlotCount>
      open_{};  // open, not dense, not beside: the new ones count
  std::array<window::Plane, window::kSlotCount> moved_{};
};

}  // namespace iog::perception
