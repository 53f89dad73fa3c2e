// Lidars whose packets iogrid does not take, by what their headers name, so that a person is told
// what it is that comes.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace iog::tools {

// "Hesai Pandar40P"; empty if the payload begins as that of no such unit. Total. Not for packets
// that one of our decoders believes.
[[nodiscard]] std::string_view name_of_foreign(std::span<const std::byte> payload);

}  // namespace iog::tools
