// Sorts in place in O(n log n) steps without recursion. std::sort is recursive, so its stack depth
// would depend on the data.
#pragma once

#include <algorithm>
#include <span>

namespace iog::numeric {

// is_less(a, b) must be a strict weak order. Equivalent values may end up in either order.
template <typename T, typename IsLess>
constexpr void heap_sort(std::span<T> values, IsLess is_less) {
  std::ranges::make_heap(values, is_less);
  std::ranges::sort_heap(values, is_less);
}

}  // namespace iog::numeric
