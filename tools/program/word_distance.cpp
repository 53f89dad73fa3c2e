#include "tools/program/word_distance.hpp"

#include <algorithm>
#include <utility>

namespace iog::tools {

std::size_t word_distance(std::string_view a, std::string_view b) {
  // Rows of the table of distances between the beginnings of a and those of b.
  std::vector<std::size_t> before_last;
  std::vector<std::size_t> last(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    last[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
    before_last = std::exchange(last, std::move(row));
  }
  return last[b.size()];
}

std::vector<std::string> nearest_words(std::string_view word, std::span<const std::string> known) {
  constexpr std::size_t kBeginning = 3;  // letters that say enough
  std::vector<std::string> nearest;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3);
  for (const std::string& each : known) {
    const bool is_beginning = word.size() >= kBeginning && each.starts_with(word);
    const std::size_t distance = is_beginning ? 1 : word_distance(word, each);
    if (distance < least) {
      nearest.clear();
    }
    if (distance <= least) {
      least = distance;
      nearest.push_back(each);
    }
  }
  return nearest;
}

}  // namespace iog::tools
