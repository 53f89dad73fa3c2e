// A read-only view of the window for sinks, tools and measurements. The view is valid until the
// next slice or frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "ageing/clock.hpp"
#include "window/tile.hpp"
#include "window/window.hpp"

namespace iog::window {

// For each tile, the clock slot of the last frame in which all of its groups were classified
// (ageing/clock.hpp).
using Refreshed = std::array<std::uint8_t, kSlotCount>;

class WindowView {
 public:
  WindowView(const Window& window, const Refreshed& refreshed, const ageing::Clock& clock)
      : window_(&window), refreshed_(&refreshed), clock_(&clock) {}

  // Returns true if the window has a position. If the window has no position, all cells are
  // unknown.
  [[nodiscard]] bool is_centred() const { return window_->is_centred(); }

  // Returns the local-frame tiles covered by the window, and their slots.
  [[nodiscard]] const Area& area() const { return window_->area(); }

  // Returns true if the tile in a slot is known. Otherwise, all cells of the tile are unknown.
  [[nodiscard]] bool is_known(std::size_t slot) const { return window_->is_known(slot); }

  // Returns the tile in a slot. If the tile is unknown, only its map content is valid.
  [[nodiscard]] const Tile& tile(std::size_t slot) const { return window_->tile(slot); }

  using ClassBytes = std::span<const std::byte, geometry::kTileCells>;

  // Returns the class bytes of the tile in a slot, row by row, starting with the lowest y. Returns
  // nothing if no cell has a class.
  [[nodiscard]] std::optional<ClassBytes> class_bytes(std::size_t slot) const;
  // Returns the class bytes of a tile even if no cell has a class. Returns nothing if the tile is
  // unknown.
  [[nodiscard]] std::optional<ClassBytes> known_bytes(std::size_t slot) const;

  // Copies the class bytes. If no cell has a class, sets all bytes to 0 and returns false.
  bool copy_classes(std::size_t slot, std::span<std::int8_t, geometry::kTileCells> to) const;

  // Returns the class byte of a cell of the local frame. If the cell is outside the window, returns
  // 0.
  [[nodiscard]] std::int8_t name_of(geometry::Cell cell) const {
    const CellPlace at = place_of(cell);
    return area().contains(cell) && is_known(at.slot)
               ? tile(at.slot).decided[at.group()][at.in_group()]
               : std::int8_t{0};
  }
  // Returns true if the cell is recorded as open ground.
  [[nodiscard]] bool is_open(geometry::Cell cell) const {
    const CellPlace at = place_of(cell);
    return area().contains(cell) && is_known(at.slot) && at.is_in(tile(at.slot).ground.open);
  }

  // Returns the classes of a cell and its eight neighbours. Bit i is set if class i occurs.
  [[nodiscard]] std::uint32_t classes_around(geometry::Cell cell) const;

  // Returns the version of the tile in a slot. The version is never 0. While the version stays the
  // same, the tile's classes stay the same (window/window.hpp). Tiles in different slots have
  // different versions.
  [[nodiscard]] std::uint32_t version(std::size_t slot) const {
    const auto number = static_cast<std::uint32_t>(slot);
    return (window_->version(slot) * std::uint32_t{kSlotCount} + number) * 2 + 1;
  }

  // Returns the age of the tile's oldest classification, in frames. The tile must be known.
  [[nodiscard]] std::uint8_t age_frames(std::size_t slot) const {
    return clock_->frames_since((*refreshed_)[slot]);
  }

 private:
  const Window* window_;
  const Refreshed* refreshed_;
  const ageing::Clock* clock_;
};

}  // namespace iog::window
