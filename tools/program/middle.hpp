// The value in the middle of unordered ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace iog::tools {

// Of an even number the upper one of the two in the middle. There is at least one value.
template <typename Value>
[[nodiscard]] Value middle_value_of(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

}  // namespace iog::tools
