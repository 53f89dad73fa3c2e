#include "tools/frames/live_classes.hpp"

#include <algorithm>

namespace iog::tools {
namespace {

constexpr std::uint32_t kOldest = 255;  // frames; that many or more

LiveClasses::Tile tile_of(const ClassGrid& classes, std::size_t slot) {
  const std::size_t tile = tile_in_window(classes.window, slot);
  LiveClasses::Tile cells{};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] = classes.cells[cell_of_tile(tile, i)];
  }
  return cells;
}

}  // namespace

void LiveClasses::take(const GridFrame& frame) {
  const stream::Header& header = frame.header;
  const bool is_next = header.run_number == run_number_ && header.frame_number == newest_frame_ + 1;
  run_number_ = header.run_number;
  newest_frame_ = header.frame_number;
  if (!frame.classes || !frame.classes->has_window()) {
    forget();
    return;
  }
  const ClassGrid& classes = *frame.classes;
  if (!is_next || (classes.window.causes & kForgettingCauses) != 0 || classes.cell_mm != cell_mm_ ||
      classes.extent != extent_) {
    forget();
  }
  move_to(classes);
  for (std::size_t slot = 0; slot < geometry::kTileCount; ++slot) {
    const window::TileNumber tile = classes.area().tile_at(slot);
    if (classes.valid_tiles.test(slot) && classes.area().contains(tile)) {
      kept_.at(slot) =
          Kept{.frame = newest_frame_, .age_frames = classes.age_frames.at(slot), .place = tile};
      tiles_.at(slot) = tile_of(classes, slot);
    }
  }
}

void LiveClasses::forget() {
  for (std::size_t slot = 0; slot < geometry::kTileCount; ++slot) {
    forget_tile(slot);
  }
  window_.reset();
}

void LiveClasses::move_to(const ClassGrid& classes) {
  window_ = classes.window;
  cell_mm_ = classes.cell_mm;
  extent_ = classes.extent;
  const window::Area area = classes.area();
  for (std::size_t slot = 0; slot < geometry::kTileCount; ++slot) {
    if (kept_.at(slot) &&
        (!area.contains(kept_.at(slot)->place) || kept_.at(slot)->place != area.tile_at(slot))) {
      forget_tile(slot);
    }
  }
}

void LiveClasses::forget_tile(std::size_t slot) {
  if (kept_.at(slot)) {
    kept_.at(slot).reset();
    tiles_.at(slot).fill(0);
  }
}

std::optional<std::uint32_t> LiveClasses::age_of(std::size_t slot) const {
  const auto& kept = kept_.at(slot);
  return kept ? std::optional(newest_frame_ - kept->frame) : std::nullopt;
}

std::optional<std::uint8_t> LiveClasses::decided_ago(std::size_t slot) const {
  const auto& kept = kept_.at(slot);
  if (!kept) {
    return std::nullopt;
  }
  const std::uint32_t since = std::min(newest_frame_ - kept->frame, kOldest);
  return static_cast<std::uint8_t>(std::min(since + kept->age_frames, kOldest));
}

std::size_t LiveClasses::stale_tiles() const {
  const auto fresh = std::ranges::count_if(
      kept_, [this](const auto& kept) { return kept && kept->frame == newest_frame_; });
  return extent_.tile_count() - static_cast<std::size_t>(fresh);
}

}  // namespace iog::tools
