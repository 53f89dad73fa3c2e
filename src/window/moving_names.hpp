// What tracks of things say of the names of cells (docs/objects.md): what hits a thing that moves
// is moving, and what nobody hits and no such thing holds is not.
//
// Only bytes of classes change, no mass and nothing that is found or remembered, and all of it is
// taken back when the next frame begins. So what the grid knows is the same with and without.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "geometry/cell.hpp"
#include "window/cell_place.hpp"
#include "window/eight_bytes.hpp"
#include "window/frame_evidence.hpp"
#include "window/window.hpp"

namespace iog::window {

class MovingNames {
 public:
  // Every name is again what the masses say.
  void take_back(Window& window);

  // A cell of the window becomes moving, at least so sure, 0 ... 7. Nothing changes where nothing
  // is known of its group.
  void give(geometry::Cell cell, std::uint8_t sureness, Window& window);

  // The masses of a tile, or its names by them, have changed. Several cores may say so of different
  // tiles.
  void note_tile(std::size_t slot, const Tile& tile);

  // A cell that is called moving and was not hit in this frame becomes unknown, but where
  // is_held(cell) says that something which moves may be there. All tiles were noted as they are.
  template <typename IsHeld>
  void withdraw(const FrameEvidence& evidence, Window& window, IsHeld&& is_held) {
    for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
      if (window.is_known(slot)) {
        withdraw(evidence, slot, window, is_held);
      }
    }
  }

 private:
  static constexpr std::size_t kGroupsPerWord = 32;
  static constexpr std::size_t kRowsPerWord = kGroupsPerWord / kGroupsPerRow;
  static_assert(kRowsPerWord == 8);
  using Groups = std::array<std::uint32_t, kGroupsPerTile / kGroupsPerWord>;

  // The cells of a group that are called moving, bit i of cell i.
  [[nodiscard]] static std::uint8_t moving_of(const decision::Decided& decided);

  template <typename IsHeld>
  void withdraw(const FrameEvidence& evidence, std::size_t slot, Window& window, IsHeld& is_held);

  void note(std::size_t slot, std::size_t group) {
    changed_[slot][group / kGroupsPerWord] |= 1U << group % kGroupsPerWord;
    is_changed_[slot] = true;
  }

  // By slot the groups in which a cell may move by the masses, and those that were renamed.
  std::array<Groups, kSlotCount> moving_{};
  std::array<Groups, kSlotCount> changed_{};
  std::array<bool, kSlotCount> is_changed_{};
};

template <typename IsHeld>
void MovingNames::withdraw(const FrameEvidence& evidence, std::size_t slot, Window& window,
                           IsHeld& is_held) {
  const Tile& tile = window.tile(slot);
  for (std::size_t word = 0; word < moving_[slot].size(); ++word) {
    const std::uint32_t groups = moving_[slot][word] | changed_[slot][word];
    for (std::uint32_t rest = groups; rest != 0; rest &= rest - 1) {
      const std::size_t group =
          word * kGroupsPerWord + static_cast<std::size_t>(std::countr_zero(rest));
      std::uint32_t left = moving_of(tile.decided[group]);
      if (left != 0 && evidence.is_touched(slot)) {
        left &= ~std::uint32_t{
            EightBytes::load(&evidence.tile(slot)[group * evidence::kGroupCells]).positive()};
      }
      for (; left != 0; left &= left - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(left));
        if (!is_held(cell_at(window.area(), slot, group, i))) {
          window.open(slot).decided[group][i] = 0;
          note(slot, group);
        }
      }
    }
  }
}

}  // namespace iog::window
