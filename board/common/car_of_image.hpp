// The car block of the image (car_block.S.in). The bytes of the car block may be invalid. Code that
// converts these bytes to a car_block::Block checks their size.
#pragma once

#include <array>
#include <cstddef>
#include <span>

// NOLINTNEXTLINE(readability-identifier-naming): a symbol of the assembly
extern "C" const std::array<std::byte, 65'536> car_block_bytes;

namespace iog::board {

[[nodiscard]] inline std::span<const std::byte, 65'536> car_of_image() { return car_block_bytes; }

}  // namespace iog::board
