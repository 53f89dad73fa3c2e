// The car's block of the image (car_block.S.in), which may be any bytes. That it has the size of
// car_block::Block is checked where one is made of it.
#pragma once

#include <array>
#include <cstddef>
#include <span>

// NOLINTNEXTLINE(readability-identifier-naming): a symbol of the assembly
extern "C" const std::array<std::byte, 65'536> car_block_bytes;

namespace iog::board {

[[nodiscard]] inline std::span<const std::byte, 65'536> car_of_image() { return car_block_bytes; }

}  // namespace iog::board
