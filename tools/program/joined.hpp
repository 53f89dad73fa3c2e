// A list as one text.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace iog::tools {

// Returns the parts, or the result of `words` for each, in their order with `by` between them. The
// first part is not empty.
template <typename Parts, typename Words = std::identity>
[[nodiscard]] std::string joined(const Parts& parts, std::string_view by, Words words = {}) {
  std::string text;
  for (const auto& part : parts) {
    text.append(text.empty() ? "" : by).append(std::invoke(words, part));
  }
  return text;
}

}  // namespace iog::tools
