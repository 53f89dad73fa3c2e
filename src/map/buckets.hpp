// The index grid of a map consists of square buckets that cover the map's extent.
#pragma once

#include <algorithm>
#include <cstdint>

#include "map/plane.hpp"

namespace iog::map {

inline constexpr std::int32_t kBucketCm = 2'560;  // side of a bucket

// A rectangle of buckets. Columns and rows are counted from the lower corner of the extent.
struct Buckets {
  std::uint32_t first_column = 0;
  std::uint32_t first_row = 0;
  std::uint32_t last_column = 0;  // inclusive
  std::uint32_t last_row = 0;

  // Returns the buckets that a box overlaps. The box must overlap the extent.
  [[nodiscard]] static constexpr Buckets of(const BoxCm& box, const BoxCm& extent) {
    const auto bucket = [](std::int32_t at, std::int32_t low, std::int32_t high) {
      return static_cast<std::uint32_t>(std::clamp(at, low, high) - low) / kBucketCm;
    };
    return {bucket(box.low.x, extent.low.x, extent.high.x),
            bucket(box.low.y, extent.low.y, extent.high.y),
            bucket(box.high.x, extent.low.x, extent.high.x),
            bucket(box.high.y, extent.low.y, extent.high.y)};
  }
  [[nodiscard]] constexpr std::uint32_t columns() const { return last_column - first_column + 1; }
  [[nodiscard]] constexpr std::uint32_t rows() const { return last_row - first_row + 1; }
  [[nodiscard]] constexpr std::uint32_t count() const { return columns() * rows(); }
  [[nodiscard]] constexpr bool holds(std::uint32_t column, std::uint32_t row) const {
    return first_column <= column && column <= last_column && first_row <= row && row <= last_row;
  }
};

}  // namespace iog::map
