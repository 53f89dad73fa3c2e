#include "window/window_view.hpp"

#include <algorithm>

#include "lanes/eight_bytes.hpp"

namespace iog::window {
namespace {

// A class byte is never below 0.
std::uint32_t bit_of_class(std::byte byte) {
  return std::uint32_t{1} << std::to_integer<unsigned>(byte) / unsigned{decision::kSurenessCount};
}

}  // namespace

std::optional<WindowView::ClassBytes> WindowView::known_bytes(std::size_t slot) const {
  if (!window_->is_known(slot)) {
    return std::nullopt;
  }
  return std::as_bytes(std::span(window_->tile(slot).decided));
}

std::optional<WindowView::ClassBytes> WindowView::class_bytes(std::size_t slot) const {
  if (!window_->is_known(slot)) {
    return std::nullopt;
  }
  const bool is_any =
      std::ranges::any_of(window_->tile(slot).decided, [](const decision::Decided& decided) {
        return !lanes::EightBytes::load(decided.data()).is_zero();
      });
  return is_any ? known_bytes(slot) : std::nullopt;
}

bool WindowView::copy_classes(std::size_t slot,
                              std::span<std::int8_t, geometry::kTileCells> to) const {
  const std::optional<ClassBytes> classes = class_bytes(slot);
  if (classes) {
    std::ranges::copy(*classes, std::as_writable_bytes(to).begin());
  } else {
    std::fill_n(to.begin(), to.size(), std::int8_t{0});
  }
  return classes.has_value();
}

std::uint32_t WindowView::classes_around(geometry::Cell cell) const {
  constexpr std::uint32_t kLast = kTileSide - 1;
  const CellPlace at = place_of(cell);
  const bool is_inner = at.x > 0 && at.x < kLast && at.y > 0 && at.y < kLast;
  std::uint32_t classes = 0;
  if (is_inner && area().contains(cell) && is_known(at.slot)) {
    const auto bytes = std::as_bytes(std::span(tile(at.slot).decided));
    for (std::uint32_t y = at.y - 1; y <= at.y + 1; ++y) {
      for (std::uint32_t x = at.x - 1; x <= at.x + 1; ++x) {
        classes |= bit_of_class(bytes[y * kTileSide + x]);
      }
    }
    return classes;
  }
  for (std::int32_t y = cell.y - 1; y <= cell.y + 1; ++y) {
    for (std::int32_t x = cell.x - 1; x <= cell.x + 1; ++x) {
      classes |= bit_of_class(std::byte(name_of({x, y})));
    }
  }
  return classes;
}

}  // namespace iog::window
