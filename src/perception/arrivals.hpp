// Detects motion onset. The Arrivals class distinguishes hits on moving objects from hits on the
// flickering edges of stationary objects.
//
// The square sizes below apply to cells of 0.1 m. With larger cells, each square keeps its size in
// metres (Rules::around), and the required number of new hits stays the same.
//
// If only low beams can open a cell (perception/opening.hpp), a hit is ignored unless a low beam
// has freed its cell and a tall return is within Rules::tall_within cells of the hit. Objects so
// low that beams pass over them are therefore never classified as moving.
//
// All conditions refer to the state before the frame. A hit is *beside* a standing object if a cell
// in the 3 by 3 square around the hit is standing. A hit is *new* if its cell was open and freed,
// and if it is not beside a standing object. A hit beside a standing object does not count as
// moving. Any other hit counts as moving if its cell was dense, or if its cell was open and the 7
// by 7 square around the hit contains enough new hits. If the cell has been found open in at least
// three periods (perception/ground.hpp), two new hits are enough. Otherwise, seven new hits are
// needed.
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
      : is_from_below_(rules.is_opened_from_below),
        tall_within_(rules.tall_within),
        around_(rules.around) {}

  // Examines all hits of a frame. Call find() before changing any tile.
  void find(const window::Window& window, const placing::FrameEvidence& evidence);

  // The steps of find(). Call begin() first. Then call find_new() or find_none() for every touched
  // slot. Finally, call find_moved() for each slot before changing its tile. `hits` contains the
  // hits in the tile's evidence. The steps for a slot may be repeated, and may run for several
  // slots concurrently.
  void begin() {
    has_new_.fill(false);
    has_open_.fill(false);
  }
  void find_new(const window::Window& window, const placing::FrameEvidence& evidence,
                std::size_t slot, const window::Plane& hits);
  void find_none(std::size_t slot) { moved_[slot] = {}; }  // for a slot without hits
  void find_moved(const window::Window& window, std::size_t slot) {
    if (has_open_[slot]) {
      count_new(window, slot);
    }
  }

  // Returns which hits in the slot's tile are classified as moved.
  [[nodiscard]] const window::Plane& moved(std::size_t slot) const { return moved_[slot]; }

 private:
  void count_new(const window::Window& window, std::size_t slot);

  bool is_from_below_;
  int tall_within_;
  Around around_;
  // If neither has_new_ nor has_open_ is set for a slot, its planes in new_ and open_ may contain
  // data from older frames.
  std::array<bool, window::kSlotCount> has_new_{};
  std::array<bool, window::kSlotCount> has_open_{};
  std::array<window::Plane, window::kSlotCount> new_{};
  std::array<window::Plane, window::kSlotCount>
      open_{};  // open, not dense and not beside a standing object: classified by the number of new
                // hits
  std::array<window::Plane, window::kSlotCount> moved_{};
};

}  // namespace iog::perception
