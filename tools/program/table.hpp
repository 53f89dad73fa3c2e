// Numbers for a person, in the rows of a table.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace iog::tools {

// One line of a table: the name padded, then the value.
[[nodiscard]] std::string row(const std::string& name, const std::string& value);

// "points_too_far" for "too far": how a script finds a number.
[[nodiscard]] std::string key_of(std::string_view prefix, std::string_view name);

// "2871 used, 17 too far", without what is 0; "none" if all are.
template <typename Counts, typename Names>
[[nodiscard]] std::string list_of(const Counts& counts, const Names& names) {
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] > 0) {
      text += (text.empty() ? "" : ", ") + std::to_string(counts[i]) + " " + std::string(names[i]);
    }
  }
  return text.empty() ? "none" : text;
}

}  // namespace iog::tools
