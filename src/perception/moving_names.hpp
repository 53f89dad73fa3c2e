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
#include "lanes/eight_bytes.hpp"
#include "placing/frame_evidence.hpp"
#include "window/tile.hpp"
#include "window/window.hpp"

namespace iog::perception {

class MovingNames {
 public:
  // Every name is again what the masses say.
  void take_back(window::Window& window);

  // A cell of the window becomes moving, at least so sure, 0 ... 7. Nothing changes where nothing
  // is known of its group.
  void give(geometry::Cell cell, std::uint8_t sureness, window::Window& window);

  // The masses of a tile, or its names by them, have changed. Several cores may say so of different
  // tiles.
  void note_tile(std::size_t slot, const window::Tile& tile);

  // A cell that is called moving and was not hit in this frame becomes unknown, but where something
  // which moves may be: held(first, asked) says where, of the cells of a group that are asked for,
  // bit i of the cell i to the right of the first. All tiles were noted as they are.
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

  // The cells of a group that are called moving, bit i of cell i.
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

  // By slot the groups in which a cell may move by the masses, and those that were renamed.
  std::array<Groups, window::kSlotCount> moving_{};
  std::array<Groups, window::kSlotCount> changed_{};
  std::array<bool, window::kSlotCount> is_changed_{};
  bool is_any_changed_ = false;
  std::array<bool, window::kSlotCount> may_move_{};  // whether there is a group in either
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
