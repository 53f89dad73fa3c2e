// The hits of a frame's slices as a list, for whoever looks for things in them.
//
// They come slice by slice, within a slice by tiles of its grid, rows and columns; so the list is
// the same for any number of cores. A cell that several slices hit, or several cells of one slice
// that lie in the same, come several times. What has no room is counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/cell.hpp"
#include "placing/frame_evidence.hpp"
#include "window/area.hpp"

namespace iog::placing {

// What was hit in a cell in one of a frame's slices.
struct Hit {
  geometry::Cell cell{};   // of the local frame
  std::uint8_t slice = 0;  // its number in the frame
  friend constexpr bool operator==(const Hit&, const Hit&) = default;
};

class HitList {
 public:
  // More than the cells that a turn of 128 layers hits (docs/objects.md).
  static constexpr std::size_t kMost = 32'768;

  // The vehicle is inside of the area, which stays the same for a frame.
  void add(std::span<const PlacedCells> slices, const window::Area& area);
  void clear();

  [[nodiscard]] std::span<const Hit> all() const { return std::span(hits_).first(count_); }
  // Hits that there was no room for.
  [[nodiscard]] std::uint32_t left() const { return left_; }

 private:
  std::size_t count_ = 0;
  std::uint32_t left_ = 0;
  std::array<Hit, kMost> hits_{};
};

}  // namespace iog::placing
