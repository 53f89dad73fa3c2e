// The occupancy index is a small integer that represents the occupancy probability of a cell.
//
// Index n represents the probability p_n of the recursive set (index/recursive_set.hpp;
// docs/model.md section 2, thesis section 3.3). Index 0 means unknown, a negative index means
// probably free, and a positive index means probably occupied.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace iog::index {

// The index as stored in a grid. The value -128 never occurs, so the range is symmetric.
using OccupancyIndex = std::int8_t;

// The range of an index in a cell of type Cell.
template <std::signed_integral Cell>
inline constexpr Cell kIndexMax = std::numeric_limits<Cell>::max();
template <std::signed_integral Cell>
inline constexpr Cell kIndexMin = -kIndexMax<Cell>;

inline constexpr OccupancyIndex kUnknown = 0;

// Fuses two indexes (docs/model.md section 2). The result is the sum of the two indexes. For int8,
// the sum saturates at -127 and 127. Both arguments must lie in [kIndexMin, kIndexMax]. For cell
// types up to int32, the sum fits in 64 bits.
template <std::signed_integral Cell>
requires(sizeof(Cell) <= 4) constexpr Cell sat_add(Cell a, Cell b) {
  using Wide = std::conditional_t<(sizeof(Cell) < 4), std::int32_t, std::int64_t>;
  return static_cast<Cell>(std::clamp<Wide>(Wide{a} + Wide{b}, kIndexMin<Cell>, kIndexMax<Cell>));
}

// Same as above, but the second argument must not be positive. Carving uses this function. The sum
// can therefore saturate only at the lower end, so the innermost loop needs one fewer comparison.
// The second argument may be a sum of many indexes, but must be above -2^30.
template <std::signed_integral Cell>
requires(sizeof(Cell) <= 2) constexpr Cell sat_lower(Cell a, std::int32_t not_positive) {
  return static_cast<Cell>(std::max<std::int32_t>(a + not_positive, kIndexMin<Cell>));
}

// Converts the result of carving to an index. Carving saturates bytes at -128, the minimum of int8.
// This value becomes -127.
constexpr OccupancyIndex raised(std::int8_t carved) {
  return std::max<OccupancyIndex>(carved, kIndexMin<OccupancyIndex>);
}

}  // namespace iog::index
