#include "tools/program/table.hpp"

#include <algorithm>

namespace iog::tools {

std::string row(const std::string& name, const std::string& value) {
  constexpr std::size_t kNameWidth = 22;
  std::string text = name;
  text.append(kNameWidth - std::min(kNameWidth - 1, name.size()), ' ');
  return text + value + "\n";
}

std::string row_if(bool is_said, const std::string& name, const std::string& value) {
  return is_said ? row(name, value) : std::string();
}

std::string counted(std::uint64_t count, std::string_view words) {
  std::string text = std::to_string(count) + ' ';
  for (std::size_t bar = words.find('|'); bar != words.npos; bar = words.find('|')) {
    const std::size_t first = words.rfind(' ', bar) + 1;  // 0 without one
    const std::size_t end = std::min(words.size(), words.find_first_of(" ,;:", bar));
    text.append(words.substr(0, first))
        .append(count == 1 ? words.substr(first, bar - first)
                           : words.substr(bar + 1, end - bar - 1));
    words.remove_prefix(end);
  }
  return text.append(words);
}

std::string percent(std::uint64_t part, std::uint64_t all) {
  return std::to_string((100 * part + all / 2) / all);
}

std::string key_of(std::string_view prefix, std::string_view name) {
  std::string key = std::string(prefix) + std::string(name);
  std::ranges::replace(key, ' ', '_');
  return key;
}

}  // namespace iog::tools
