// Sorts in place, in n log n steps, without recursion: std::sort calls itself, so how deep the
// stack becomes below it would follow from the data.
#pragma once

#include <algorithm>
#include <span>

namespace iog::numeric {

// is_less(a, b): a strict order. Of two values of which neither is less, either may come first.
template <typename T, typename IsLess>
constexpr void heap_sort(std::span<T> values, IsLess is_less) {
  std::ranges::make_heap(values, is_less);
  std::ranges::sort_heap(values, is_less);
}

}  // namespace iog::numeric
