// The window for whoever looks at it: sinks, tools and measurements. It changes nothing, and is
// valid until the next slice or frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "ageing/clock.hpp"
#include "window/tile.hpp"
#include "window/window.hpp"

namespace iog::window {

// By slot, the clock's slot of the frame in which all groups of the tile were decided last.
using Refreshed = std::array<std::uint8_t, kSlotCount>;

class WindowView {
 public:
  WindowView(const Window& window, const Refreshed& refreshed, const ageing::Clock& clock)
      : window_(&window), refreshed_(&refreshed), clock_(&clock) {}

  // Whether the window has a place; without one nothing is known.
  [[nodiscard]] bool is_centred() const { return window_->is_centred(); }

  // Which tiles of the local frame the window has, and at which slots.
  [[nodiscard]] const Area& area() const { return window_->area(); }

  // Whether something was ever known of the tile at a slot. If not, all of its cells are unknown.
  [[nodiscard]] bool is_known(std::size_t slot) const { return window_->is_known(slot); }

  // All of the tile at a slot. If it is not known, what the map says of it, and nothing else.
  [[nodiscard]] const Tile& tile(std::size_t slot) const { return window_->tile(slot); }

  using ClassBytes = std::span<const std::byte, geometry::kTileCells>;

  // The class bytes of the tile at a slot, row by row from its lowest y, as they lie in memory.
  // Empty if no cell has a class.
  [[nodiscard]] std::optional<ClassBytes> class_bytes(std::size_t slot) const;
  // The same where no cell has a class, if something was ever known of the tile.
  [[nodiscard]] std::optional<ClassBytes> known_bytes(std::size_t slot) const;

  // A copy of them. False if no cell has a class: all are 0 then.
  bool copy_classes(std::size_t slot, std::span<std::int8_t, geometry::kTileCells> to) const;

  // The class byte of a cell of the local frame; 0 outside of the window.
  [[nodiscard]] std::int8_t name_of(geometry::Cell cell) const {
    const CellPlace at = place_of(cell);
    return area().contains(cell) && is_known(at.slot)
               ? tile(at.slot).decided[at.group()][at.in_group()]
               : std::int8_t{0};
  }
  // Whether it is remembered that the ground there was open.
  [[nodiscard]] bool is_open(geometry::Cell cell) const {
    const CellPlace at = place_of(cell);
    return area().contains(cell) && is_known(at.slot) && at.is_in(tile(at.slot).ground.open);
  }

  // Which classes the nine cells around one have, itself included: bit i is of the class i.
  [[nodiscard]] std::uint32_t classes_around(geometry::Cell cell) const;

  // It stays as long as the classes of the tile at a slot do (window/window.hpp).
  [[nodiscard]] std::uint32_t version(std::size_t slot) const { return window_->version(slot); }

  // How many frames ago the oldest of them was decided. Of a tile that is known.
  [[nodiscard]] std::uint8_t age_frames(std::size_t slot) const {
    return clock_->frames_since((*refreshed_)[slot]);
  }

 private:
  const Window* window_;
  const Refreshed* refreshed_;
  const ageing::Clock* clock_;
};

}  // namespace iog::window
