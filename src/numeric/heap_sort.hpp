// Sorts in place without recursion, in O(n log n) steps. `std::sort` is not used because it is
// recursive, so its stack depth depends on the data.
#pragma once

#include <algorithm>
#include <span>

namespace iog::numeric {

// `is_less(a, b)` must be a strict weak ordering. The order of equivalent values is unspecified.
template <typename T, typename IsLess>
constexpr void heap_sort(std::span<T> values, IsLess is_less) {
  std::ranges::make_heap(values, is_less);
  std::ranges::sort_heap(values, is_less);
}

}  // namespace iog::numeric
