// Names with numbers in the order of these numbers: part_2 before part_10.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace iog::tools {

// The digits of each number without leading zeros, behind their count: such keys compare letter by
// letter as the names compare number by number. Numbers of more than 255 digits compare by any
// order.
[[nodiscard]] inline std::pair<std::string, std::string> natural_key(std::string_view name) {
  const auto is_digit = [](char letter) { return letter >= '0' && letter <= '9'; };
  std::string key;
  for (std::size_t at = 0; at < name.size();) {
    if (!is_digit(name[at])) {
      key += name[at++];
      continue;
    }
    std::size_t end = at;
    while (end < name.size() && is_digit(name[end])) {
      ++end;
    }
    while (at + 1 < end && name[at] == '0') {
      ++at;
    }
    key.append({'0', static_cast<char>(end - at)}).append(name.substr(at, end - at));
    at = end;
  }
  return {key, std::string(name)};
}

}  // namespace iog::tools
