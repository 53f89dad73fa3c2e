#include "perception/moving_names.hpp"

#include <algorithm>
#include <span>

namespace iog::perception {
namespace {

constexpr auto kMoving =
    static_cast<std::int8_t>(decision::kSurenessCount * static_cast<int>(decision::Class::kMoving));

}  // namespace

std::uint8_t MovingNames::moving_of(const decision::Decided& decided) {
  constexpr lanes::EightBytes kClassBits = lanes::EightBytes::all(-decision::kSurenessCount);
  constexpr lanes::EightBytes kClass = lanes::EightBytes::all(kMoving);
  const lanes::EightBytes differs =
      lanes::EightBytes::load(decided.data()).bit_and(kClassBits).bit_xor(kClass);
  return static_cast<std::uint8_t>(~differs.positive());
}

// Looks only at occupied cells: a cell with less than a quarter of its mass occupied is never
// moving by its masses (decision/decision.hpp).
void MovingNames::note_tile(std::size_t slot, const window::Tile& tile) {
  Groups groups = changed_[slot];
  std::uint32_t any = 0;
  for (std::size_t word = 0; word < groups.size(); ++word) {
    const auto rows =
        std::span(tile.found.taken).subspan(word * kRowsPerWord).first<kRowsPerWord>();
    if ((rows[0] | rows[1] | rows[2] | rows[3] | rows[4] | rows[5] | rows[6] | rows[7]) == 0) {
      any |= groups[word];
      continue;
    }
    for (std::size_t y = 0; y < rows.size(); ++y) {
      for (std::uint32_t left = rows[y]; left != 0;) {
        const auto in_row =
            static_cast<std::size_t>(std::countr_zero(left)) / evidence::kGroupCells;
        const std::size_t group = y * window::kGroupsPerRow + in_row;
        const bool is_any = moving_of(tile.decided[word * kGroupsPerWord + group]) != 0;
        groups[word] |= (is_any ? 1U : 0U) << group;
        left &= ~(std::uint32_t{0xFF} << in_row * evidence::kGroupCells);
      }
    }
    any |= groups[word];
  }
  moving_[slot] = groups;
  may_move_[slot] = any != 0;
}

void MovingNames::take_back(window::Window& window) {
  if (!is_any_changed_) {
    return;
  }
  is_any_changed_ = false;
  for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
    if (!is_changed_[slot]) {
      continue;
    }
    for (std::size_t word = 0; word < changed_[slot].size(); ++word) {
      for (std::uint32_t left = changed_[slot][word]; left != 0; left &= left - 1) {
        window.name_anew(slot,
                         word * kGroupsPerWord + static_cast<std::size_t>(std::countr_zero(left)));
      }
    }
    changed_[slot] = {};
    is_changed_[slot] = false;
  }
}

void MovingNames::give(geometry::Cell cell, std::uint8_t sureness, window::Window& window) {
  const window::CellPlace at = window::place_of(cell);
  if (!window.is_known(at.slot) || !window.tile(at.slot).is_known(at.group())) {
    return;
  }
  std::int8_t& byte = window.open(at.slot).decided[at.group()][at.in_group()];
  const bool is_moving = decision::class_of(byte) == decision::Class::kMoving;
  const auto named = static_cast<std::int8_t>(kMoving + sureness);
  byte = is_moving ? std::max(byte, named) : named;
  note(at.slot, at.group());
}

}  // namespace iog::perception
