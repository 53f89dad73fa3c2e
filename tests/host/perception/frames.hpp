// A window that is given whole frames, and is asked for classes of cells.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "perception/plain_fusion.hpp"
#include "perception/window_fusion.hpp"
#include "placing/slice.hpp"

namespace iog::perception {

using geometry::Cell;
using tests::PlacedSlice;
using tests::Slice;
using ClassBytes = std::array<std::int8_t, geometry::kTileCells>;

inline constexpr std::uint64_t kFrameUs = 40'000;

inline placing::Placement at_cell(Cell vehicle, std::uint16_t cell_mm = geometry::kCellMm) {
  placing::Placement at = tests::placed(vehicle.x * cell_mm, vehicle.y * cell_mm);
  at.grid.cell_mm = cell_mm;
  return at;
}

inline decision::Class class_of(std::int8_t byte) { return static_cast<decision::Class>(byte / 8); }

// Adds a slice to a window, with the vehicle there.
inline void add_slice(const Slice& slice, const placing::Placement& at, WindowFusion& fusion) {
  const auto cells = std::make_unique<placing::SliceCells>();
  tests::hand_over(slice, *cells);
  const placing::PlacedCells placed{.cells = cells.get(), .at = at};
  fusion.add(std::span(&placed, 1));
}

// A window that is given whole frames.
class Fusion {
 public:
  explicit Fusion(const Rules& rules = {}) : fusion_(std::make_unique<WindowFusion>(rules)) {}

  FrameCounts frame(const std::vector<PlacedSlice>& slices, std::uint64_t stamp_us) {
    for (const auto& [slice, vehicle] : slices) {
      add_slice(slice, at_cell(vehicle), *fusion_);
    }
    return fusion_->finish(stamp_us);
  }
  // A frame every 40 ms.
  FrameCounts frame(const std::vector<PlacedSlice>& slices) {
    now_us_ += kFrameUs;
    return frame(slices, now_us_);
  }
  void follow(Cell vehicle) { fusion_->follow(at_cell(vehicle).pose); }
  void forget() { fusion_->forget(); }

  [[nodiscard]] window::WindowView view() const { return fusion_->view(); }

  [[nodiscard]] decision::Class class_at(Cell cell) const {
    const window::TileNumber tile{numeric::div_floor(cell.x, window::kTileSide),
                                  numeric::div_floor(cell.y, window::kTileSide)};
    ClassBytes bytes;
    view().copy_classes(window::slot_of(tile), bytes);
    const std::int32_t in_tile = (cell.y - tile.b * window::kTileSide) * window::kTileSide +
                                 cell.x - tile.a * window::kTileSide;
    return class_of(bytes[static_cast<std::size_t>(in_tile)]);
  }

  [[nodiscard]] std::vector<ClassBytes> classes() const {
    std::vector<ClassBytes> tiles(window::kSlotCount);
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      view().copy_classes(slot, tiles[slot]);
    }
    return tiles;
  }
  [[nodiscard]] std::size_t known_tiles() const {
    std::size_t known = 0;
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      known += view().is_known(slot) ? 1U : 0U;
    }
    return known;
  }

 private:
  std::unique_ptr<WindowFusion> fusion_;
  std::uint64_t now_us_ = 0;
};

}  // namespace iog::perception
