// Converts a tile of indexes to bytes (placing/slice_byte.hpp), and records which parts of the tile
// are known. `slice_bytes.cpp` is the reference implementation. CMake selects either
// slice_bytes.cpp or slice_bytes_neon.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/grid.hpp"
#include "placing/slice_byte.hpp"

namespace iog::placing {

// Known cells are recorded in squares of 4 by 4 cells, with one bit per square and eight squares
// per row.
inline constexpr std::uint32_t kSquareSide = 4;
inline constexpr std::size_t kSquaresOfTile = geometry::kTileSide / kSquareSide;
static_assert(kSquaresOfTile == 8, "a byte a row of squares of a tile");

struct TileNotes {
  std::array<std::uint8_t, kSquaresOfTile> known{};  // by row of squares; bit i is square i
  std::uint8_t hit_bands = 0;  // bit i: a cell in rows 8 * i ... 8 * i + 7 is hit
  friend bool operator==(const TileNotes&, const TileNotes&) = default;
};

// Writes the bytes of a tile, row by row, with all extra bits clear. The indexes must not be -128.
[[nodiscard]] TileNotes write_bytes(const std::int8_t* indexes, std::int8_t* bytes);

// Sets the extra bit of the given cells of a tile. The cells must be known, and their extra bits
// must be clear.
void set_beside(const window::Plane& cells, std::int8_t* bytes);

}  // namespace iog::placing
