// Hardware interface for a text console. A call blocks only as long as the transmission of its
// bytes takes.
#pragma once

#include <concepts>
#include <string_view>

namespace iog::hal {

template <typename T>
concept Console = requires(T& console, std::string_view text) {
  { console.write(text) } -> std::same_as<void>;
};

}  // namespace iog::hal
