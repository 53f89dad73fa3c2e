// Lists the hits of a frame's slices for tracking.
//
// The hits are ordered by slice, and then by tile, row and column of the slice grid, so their order
// does not depend on the number of cores. A window cell that is hit in several slices, or by
// several cells of one slice, is listed once for each of these hits. Hits beyond the capacity are
// dropped and counted.
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
  // The capacity of the list. A sensor with 128 layers hits fewer cells in one turn
  // (docs/objects.md).
  static constexpr std::size_t kMost = 32'768;

  // The vehicle must be inside the area, and the area must not change within a frame.
  void add(std::span<const PlacedCells> slices, const window::Area& area);
  void clear();

  [[nodiscard]] std::span<const Hit> all() const { return std::span(hits_).first(count_); }
  // Returns the number of hits that were dropped because the list was full.
  [[nodiscard]] std::uint32_t left() const { return left_; }

 private:
  std::size_t count_ = 0;
  std::uint32_t left_ = 0;
  std::array<Hit, kMost> hits_{};
};

}  // namespace iog::placing
