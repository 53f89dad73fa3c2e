// One leaf of a quarter tile after the other, in Morton order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "index/occupancy_index.hpp"
#include "lab/tree/block.hpp"
#include "lab/tree/tile_shape.hpp"

namespace iog::tree {

// The lowest cell of a tile's quarter, from that of the tile.
[[nodiscard]] constexpr Cell<2> quarter_corner(const Cell<2>& tile_corner, std::size_t quarter) {
  const auto number = static_cast<std::uint32_t>(quarter);
  return {tile_corner[0] + ((number & 1U) << kQuarterSideLog2),
          tile_corner[1] + ((number >> 1) << kQuarterSideLog2)};
}

class QuarterLeaves {
 public:
  // leaves: as many as the shape says. Both outlive this.
  QuarterLeaves(const QuarterShape& shape, std::span<const std::byte> leaves)
      : shape_(&shape), leaves_(leaves), side_log2_(shape.side_log2_at(0)) {}

  [[nodiscard]] bool at_end() const { return place_ == kQuarterCells; }

  // Not at the end:
  [[nodiscard]] index::OccupancyIndex index() const {
    return static_cast<index::OccupancyIndex>(leaves_[number_]);
  }

  [[nodiscard]] Block<2> block(const Cell<2>& corner_of_quarter) const {
    const Cell<2> offset = morton_cell<2>(place_);
    return {{corner_of_quarter[0] + offset[0], corner_of_quarter[1] + offset[1]}, side_log2_};
  }

  void next() {
    place_ += 1U << (2 * side_log2_);
    ++number_;
    if (!at_end()) {
      side_log2_ = shape_->side_log2_at(place_);
    }
  }

 private:
  const QuarterShape* shape_;
  std::span<const std::byte> leaves_;
  std::uint32_t place_ = 0;
  std::uint32_t number_ = 0;
  std::uint32_t side_log2_;
};

}  // namespace iog::tree
