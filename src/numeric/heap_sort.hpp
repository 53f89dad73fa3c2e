// Sorts in place in O(n log n) steps without recursion. std::sort is recursive, so the data would
// determine its stack depth.
#pragma once

#include <algorithm>
#include <span>

namespace iog::numeric {

// is_less(a, b): a strict order. Equivalent values may end up in either order.
template <typename T, typename IsLess>
constexpr void heap_sort(std::span<T> values, IsLess is_less) {
  std::ranges::make_heap(values, is_less);
  std::ranges::sort_heap(values, is_less);
}

}  // namespace iog::numeric
