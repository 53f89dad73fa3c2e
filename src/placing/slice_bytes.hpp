// The bytes of a tile of a slice (placing/slice_byte.hpp), and where something is known in it.
// slice_bytes.cpp says what; CMake chooses how, slice_bytes.cpp or slice_bytes_neon.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/grid.hpp"
#include "placing/slice_byte.hpp"

namespace iog::placing {

// What is known is noted by squares of four by four cells, a bit each, eight of them a row.
inline constexpr std::uint32_t kSquareSide = 4;
inline constexpr std::size_t kSquaresOfTile = geometry::kTileSide / kSquareSide;
static_assert(kSquaresOfTile == 8, "a byte a row of squares of a tile");

struct TileNotes {
  std::array<std::uint8_t, kSquaresOfTile> known{};  // by row of squares, bit i: square i
  std::uint8_t hit_bands = 0;  // bit i: something is hit in the rows 8 i ... 8 i + 7
  friend bool operator==(const TileNotes&, const TileNotes&) = default;
};

// Writes the bytes of a tile's indexes, row by row, without a bit beside them. No index is -128.
[[nodiscard]] TileNotes write_bytes(const std::int8_t* indexes, std::int8_t* bytes);

// Sets the bit beside the index of these cells of a tile, all of which are known and have none.
void set_beside(const window::Plane& cells, std::int8_t* bytes);

}  // namespace iog::placing
