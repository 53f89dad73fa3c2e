// Read-only view of the window for sinks, tools and measurements. Valid until the next slice or
// frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "ageing/clock.hpp"
#include "window/tile.hpp"
#include "window/window.hpp"

namespace iog::window {

// By slot: the clock's slot of the last frame in which all groups of the tile were decided.
using Refreshed = std::array<std::uint8_t, kSlotCount>;

class WindowView {
 public:
  WindowView(const Window& window, const Refreshed& refreshed, const ageing::Clock& clock)
      : window_(&window), refreshed_(&refreshed), clock_(&clock) {}

  // Whether the window has a position. Without one everything is unknown.
  [[nodiscard]] bool is_centred() const { return window_->is_centred(); }

  // Which tiles of the local frame the window covers, and their slots.
  [[nodiscard]] const Area& area() const { return window_->area(); }

  // Whether the tile at a slot was ever known. If not, all of its cells are unknown.
  [[nodiscard]] bool is_known(std::size_t slot) const { return window_->is_known(slot); }

  // The tile at a slot. If it is unknown, only its map content is valid.
  [[nodiscard]] const Tile& tile(std::size_t slot) const { return window_->tile(slot); }

  using ClassBytes = std::span<const std::byte, geometry::kTileCells>;

  // The class bytes of the tile at a slot, row by row from its lowest y. Empty if no cell has a
  // class.
  [[nodiscard]] std::optional<ClassBytes> class_bytes(std::size_t slot) const;
  // The class bytes of any tile that was ever known, even if no cell has a class.
  [[nodiscard]] std::optional<ClassBytes> known_bytes(std::size_t slot) const;

  // Copies them. Returns false if no cell has a class; all bytes are then 0.
  bool copy_classes(std::size_t slot, std::span<std::int8_t, geometry::kTileCells> to) const;

  // The class byte of a cell of the local frame. 0 outside the window.
  [[nodiscard]] std::int8_t name_of(geometry::Cell cell) const {
    const CellPlace at = place_of(cell);
    return area().contains(cell) && is_known(at.slot)
               ? tile(at.slot).decided[at.group()][at.in_group()]
               : std::int8_t{0};
  }
  // Whether the ground there was open.
  [[nodiscard]] bool is_open(geometry::Cell cell) const {
    const CellPlace at = place_of(cell);
    return area().contains(cell) && is_known(at.slot) && at.is_in(tile(at.slot).ground.open);
  }

  // The classes of the nine cells around a cell, itself included: bit i stands for class i.
  [[nodiscard]] std::uint32_t classes_around(geometry::Cell cell) const;

  // Does not change while the classes of the tile at a slot stay the same (window/window.hpp).
  [[nodiscard]] std::uint32_t version(std::size_t slot) const { return window_->version(slot); }

  // The age of the tile's oldest decision in frames. The tile must be known.
  [[nodiscard]] std::uint8_t age_frames(std::size_t slot) const {
    return clock_->frames_since((*refreshed_)[slot]);
  }

 private:
  const Window* window_;
  const Refreshed* refreshed_;
  const ageing::Clock* clock_;
};

}  // namespace iog::window
