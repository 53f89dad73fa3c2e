// Which of the words that are known somebody may have meant.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace iog::tools {

// Letters that have to be inserted, removed, replaced or exchanged with their neighbour to make one
// word of the other (optimal string alignment).
[[nodiscard]] std::size_t word_distance(std::string_view a, std::string_view b);

// The nearest ones; none if all are farther than a third of the word's letters. A word
// of which this one is the beginning is as near as one with a wrong letter.
[[nodiscard]] std::vector<std::string> nearest_words(std::string_view word,
                                                     std::span<const std::string> known);

}  // namespace iog::tools
