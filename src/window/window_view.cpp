#include "window/window_view.hpp"

#include <algorithm>

#include "window/cell_place.hpp"
#include "window/eight_bytes.hpp"

namespace iog::window {

std::optional<WindowView::ClassBytes> WindowView::class_bytes(std::size_t slot) const {
  if (!window_->is_known(slot)) {
    return std::nullopt;
  }
  const auto& groups = window_->tile(slot).decided;
  const bool is_any = std::ranges::any_of(groups, [](const decision::Decided& decided) {
    return !EightBytes::load(decided.data()).is_zero();
  });
  return is_any ? std::optional(std::as_bytes(std::span(groups))) : std::nullopt;
}

bool WindowView::copy_classes(std::size_t slot,
                              std::span<std::int8_t, geometry::kTileCells> to) const {
  const std::optional<ClassBytes> classes = class_bytes(slot);
  if (classes) {
    std::ranges::copy(*classes, std::as_writable_bytes(to).begin());
  } else {
    std::ranges::fill(to, std::int8_t{0});
  }
  return classes.has_value();
}

std::int8_t WindowView::name_of(geometry::Cell cell) const {
  const CellPlace at = place_of(cell);
  return area().contains(cell) && is_known(at.slot)
             ? tile(at.slot).decided[at.group()][at.in_group()]
             : std::int8_t{0};
}

bool WindowView::is_open(geometry::Cell cell) const {
  const CellPlace at = place_of(cell);
  return area().contains(cell) && is_known(at.slot) && at.is_in(tile(at.slot).ground.open);
}

}  // namespace iog::window
