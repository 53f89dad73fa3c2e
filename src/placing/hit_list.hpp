// Lists the hits of a frame's slices for tracking.
//
// The hits are ordered by slice, then by tile of the slice grid, row and column, so their order
// does not depend on the number of cores. A cell is listed several times if several slices, or
// several cells of one slice, hit it. Hits that exceed the capacity are counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/cell.hpp"
#include "placing/frame_evidence.hpp"
#include "window/area.hpp"

namespace iog::placing {

// A window cell that was hit in one slice of the frame.
struct Hit {
  geometry::Cell cell{};   // in the local frame
  std::uint8_t slice = 0;  // number of the slice in the frame
  friend constexpr bool operator==(const Hit&, const Hit&) = default;
};

class HitList {
 public:
  // More than the number of cells that one turn of 128 layers can hit (docs/objects.md).
  static constexpr std::size_t kMost = 32'768;

  // The vehicle must be inside the area, and the area must stay the same for a frame.
  void add(std::span<const PlacedCells> slices, const window::Area& area);
  void clear();

  [[nodiscard]] std::span<const Hit> all() const { return std::span(hits_).first(count_); }
  // The number of hits that were dropped because the list was full.
  [[nodiscard]] std::uint32_t left() const { return left_; }

 private:
  std::size_t count_ = 0;
  std::uint32_t left_ = 0;
  std::array<Hit, kMost> hits_{};
};

}  // namespace iog::placing
