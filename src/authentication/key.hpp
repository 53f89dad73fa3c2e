// The AES-128 key that the sender and the target share.
#pragma once

#include <array>
#include <cstddef>

namespace iog::authentication {

inline constexpr std::size_t kBlockBytes = 16;

using Block = std::array<std::byte, kBlockBytes>;
using Key = Block;

}  // namespace iog::authentication
