#include "placing/slice_bytes.hpp"

#include <algorithm>
#include <bit>

namespace iog::placing {

TileNotes write_bytes(const std::int8_t* indexes, std::int8_t* bytes) {
  constexpr std::int8_t kMost = kMostIndex;
  constexpr std::size_t kSide = geometry::kTileSide;
  constexpr std::size_t kRowsOfBand = 8;
  TileNotes notes;
  for (std::size_t y = 0; y < kSide; ++y) {
    for (std::size_t x = 0; x < kSide; ++x) {
      const std::int8_t index = indexes[y * kSide + x];
      bytes[y * kSide + x] = std::clamp<std::int8_t>(index, -kMost, kMost);
      std::uint8_t& known = notes.known[y / kSquareSide];
      known = static_cast<std::uint8_t>(known | (index != 0 ? 1U : 0U) << x / kSquareSide);
      notes.hit_bands =
          static_cast<std::uint8_t>(notes.hit_bands | (index > 0 ? 1U : 0U) << y / kRowsOfBand);
    }
  }
  return notes;
}

// The extra bit toggles bit 5 of the byte, which is 0 for indexes 1 ... 31 and 1 for -1 ... -31.
void set_beside(const window::Plane& cells, std::int8_t* bytes) {
  for (std::uint32_t row : cells) {
    for (; row != 0; row &= row - 1) {
      std::int8_t& byte = bytes[std::countr_zero(row)];
      byte = static_cast<std::int8_t>(byte ^ kBeside);
    }
    bytes += geometry::kTileSide;
  }
}

}  // namespace iog::placing
