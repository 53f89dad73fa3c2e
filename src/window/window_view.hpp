// The window for whoever looks at it: sinks, tools and measurements. It changes nothing, and is
// valid until the next slice or frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "ageing/clock.hpp"
#include "window/window.hpp"

namespace iog::window {

// By slot, the clock's slot of the frame in which all groups of the tile were decided last.
using Refreshed = std::array<std::uint8_t, kSlotCount>;

class WindowView {
 public:
  WindowView(const Window& window, const Refreshed& refreshed, const ageing::Clock& clock)
      : window_(&window), refreshed_(&refreshed), clock_(&clock) {}

  // Which tiles of the local frame the window has, and at which slots.
  [[nodiscard]] const Area& area() const { return window_->area(); }

  // Whether something was ever known of the tile at a slot. If not, all of its cells are unknown.
  [[nodiscard]] bool is_known(std::size_t slot) const { return window_->is_known(slot); }

  // The class bytes of the tile at a slot, row by row from its lowest y. False if it is not known.
  bool copy_classes(std::size_t slot, std::span<std::int8_t, geometry::kTileCells> to) const;

  // How long ago the oldest of them was decided, in ms. Of a tile that is known.
  [[nodiscard]] std::uint32_t age_ms(std::size_t slot) const {
    return clock_->ms_since((*refreshed_)[slot]);
  }

 private:
  const Window* window_;
  const Refreshed* refreshed_;
  const ageing::Clock* clock_;
};

}  // namespace iog::window
