// A list as one text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace iog::tools {

// The parts in their order, with `by` between them.
[[nodiscard]] inline std::string joined(const std::vector<std::string>& parts,
                                        std::string_view by) {
  std::string text;
  for (const std::string& part : parts) {
    text.append(text.empty() ? "" : by).append(part);
  }
  return text;
}

}  // namespace iog::tools
