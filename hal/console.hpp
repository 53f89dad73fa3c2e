// The seam to a line of text for a person. Never blocks for longer than the bytes take to shift
// out.
#pragma once

#include <concepts>
#include <string_view>

namespace iog::hal {

template <typename T>
concept Console = requires(T& console, std::string_view text) {
  { console.write(text) } -> std::same_as<void>;
};

}  // namespace iog::hal
