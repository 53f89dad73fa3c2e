// Relabels cells according to tracks (docs/objects.md). Cells that contain hits of moving tracks
// become moving. A moving cell loses the class `moving` if it was not hit and is outside the boxes
// of all moving tracks.
//
// Relabelling changes only class bytes, never masses or the ground memory. All changes are undone
// when the next frame begins, so the masses in the grid are the same with and without tracks.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "geometry/cell.hpp"
#include "lanes/eight_bytes.hpp"
#include "placing/frame_evidence.hpp"
#include "window/tile.hpp"
#include "window/window.hpp"

namespace iog::perception {

class MovingNames {
 public:
  // Restores all class labels from the masses.
  void take_back(window::Window& window);

  // Relabels a cell of the window as moving, with a confidence of at least `sureness`, which is
  // between 0 and 7. The call has no effect if the cell's group is unknown.
  void give(geometry::Cell cell, std::uint8_t sureness, window::Window& window);

  // Call note_tile() after the masses of a tile, or the labels computed from them, have changed.
  // Several cores may call note_tile() for different tiles.
  void note_tile(std::size_t slot, const window::Tile& tile);

  // Relabels a moving cell as unknown if it was not hit in this frame and no moving object can
  // cover it. `held(first, asked)` returns the cells in the set `asked` that moving objects may
  // cover. All cells are in one group. Bit 0 is the cell `first`, and bit i is the i-th cell to the
  // right of `first`. Call note_tile() for all changed tiles first.
  template <typename Held>
  void withdraw(const placing::FrameEvidence& evidence, window::Window& window, Held&& held) {
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      if (may_move_[slot] && window.is_known(slot)) {
        withdraw(evidence, slot, window, held);
      }
    }
  }

 private:
  static constexpr std::size_t kGroupsPerWord = 32;
  static constexpr std::size_t kRowsPerWord = kGroupsPerWord / window::kGroupsPerRow;
  static_assert(kRowsPerWord == 8);
  using Groups = std::array<std::uint32_t, window::kGroupsPerTile / kGroupsPerWord>;

  // Returns the moving cells of a group. Bit i of the result represents cell i.
  [[nodiscard]] static std::uint8_t moving_of(const decision::Decided& decided);

  template <typename Held>
  void withdraw(const placing::FrameEvidence& evidence, std::size_t slot, window::Window& window,
                Held& held);

  void note(std::size_t slot, std::size_t group) {
    changed_[slot][group / kGroupsPerWord] |= 1U << group % kGroupsPerWord;
    is_changed_[slot] = true;
    is_any_changed_ = true;
    may_move_[slot] = true;
  }

  // For each slot, moving_ contains the groups in which the masses may classify a cell as moving,
  // and changed_ contains the relabelled groups.
  std::array<Groups, window::kSlotCount> moving_{};
  std::array<Groups, window::kSlotCount> changed_{};
  std::array<bool, window::kSlotCount> is_changed_{};
  bool is_any_changed_ = false;
  std::array<bool, window::kSlotCount> may_move_{};  // whether the slot has such a group
};

template <typename Held>
void MovingNames::withdraw(const placing::FrameEvidence& evidence, std::size_t slot,
                           window::Window& window, Held& held) {
  const window::Tile& tile = window.tile(slot);
  const std::int8_t* const hits = evidence.is_touched(slot) ? evidence.tile(slot).data() : nullptr;
  for (std::size_t word = 0; word < moving_[slot].size(); ++word) {
    const std::uint32_t groups = moving_[slot][word] | changed_[slot][word];
    for (std::uint32_t rest = groups; rest != 0; rest &= rest - 1) {
      const std::size_t group =
          word * kGroupsPerWord + static_cast<std::size_t>(std::countr_zero(rest));
      std::uint32_t left = moving_of(tile.decided[group]);
      if (left != 0 && hits != nullptr) {
        left &= ~std::uint32_t{
            lanes::EightBytes::load(&hits[group * evidence::kGroupCells]).positive()};
      }
      if (left != 0) {
        left &= ~held(window::cell_at(window.area(), slot, group, 0), left);
      }
      if (left == 0) {
        continue;
      }
      decision::Decided& decided = window.open(slot).decided[group];
      for (; left != 0; left &= left - 1) {
        decided[static_cast<std::size_t>(std::countr_zero(left))] = 0;
      }
      note(slot, group);
    }
  }
}

}  // namespace iog::perception
