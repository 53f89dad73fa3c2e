// Numbers for a person, in the rows of a table.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace iog::tools {

// Names and values, for a script: "frames_with_evidence" and "250".
using Facts = std::vector<std::pair<std::string, std::string>>;

// One line of a table: the name padded, then the value; of row_if() none if there is nothing to
// say.
[[nodiscard]] std::string row(const std::string& name, const std::string& value);
[[nodiscard]] std::string row_if(bool is_said, const std::string& name, const std::string& value);

// "points_too_far" for "too far": how a script finds a number.
[[nodiscard]] std::string key_of(std::string_view prefix, std::string_view name);

inline void add_fact(Facts& facts, const std::string& name, std::uint64_t value) {
  facts.emplace_back(name, std::to_string(value));
}

// "points_used" and "points_too_far" of as many counts.
template <typename Counts, typename Names>
void add_facts(Facts& facts, std::string_view prefix, const Counts& counts, const Names& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    add_fact(facts, key_of(prefix, names[i]), counts[i]);
  }
}

// "1 cloud has no stamp", "2 clouds have no stamp" by "cloud|clouds has|have no stamp".
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view words);

// Rounded; all > 0.
[[nodiscard]] std::string percent(std::uint64_t part, std::uint64_t all);

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
