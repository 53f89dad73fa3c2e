// The occupancy index: one small integer that stands for the occupancy probability of a cell.
//
// docs/model.md section 2, thesis section 3.3. Index n stands for the probability p_n of the
// recursive set (index/recursive_set.hpp): 0 is unknown, below 0 likely free, above 0 likely
// occupied.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace iog::index {

// The index as it is stored in a grid. -128 never occurs, so that the range is symmetric.
using OccupancyIndex = std::int8_t;

// The range of an index in a cell of type Cell. Smaller epsilon needs a wider cell: same code.
template <std::signed_integral Cell>
inline constexpr Cell kIndexMax = std::numeric_limits<Cell>::max();
template <std::signed_integral Cell>
inline constexpr Cell kIndexMin = -kIndexMax<Cell>;

inline constexpr OccupancyIndex kUnknown = 0;

// Fusion of two indexes (docs/model.md section 2): their sum, saturated at +-127 for int8. Both
// arguments lie in [kIndexMin, kIndexMax]; the sum of two fits 64 bits for cells up to int32.
template <std::signed_integral Cell>
requires(sizeof(Cell) <= 4) constexpr Cell sat_add(Cell a, Cell b) {
  using Wide = std::conditional_t<(sizeof(Cell) < 4), std::int32_t, std::int64_t>;
  return static_cast<Cell>(std::clamp<Wide>(Wide{a} + Wide{b}, kIndexMin<Cell>, kIndexMax<Cell>));
}

// The same sum if what is added is known not to be positive, as in carving. It can then saturate
// only at the lower end, which saves one comparison in the innermost loop. What is added may be a
// sum of many indexes, above -2^30.
template <std::signed_integral Cell>
requires(sizeof(Cell) <= 2) constexpr Cell sat_lower(Cell a, std::int32_t not_positive) {
  return static_cast<Cell>(std::max<std::int32_t>(a + not_positive, kIndexMin<Cell>));
}

// A byte that was carved with the floor of bytes, -128, as an index: -128 is -127.
constexpr OccupancyIndex raised(std::int8_t carved) {
  return std::max<OccupancyIndex>(carved, kIndexMin<OccupancyIndex>);
}

}  // namespace iog::index
