#include "map/tile_mask.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace iog::map {
namespace {

static_assert(std::endian::native == std::endian::little, "the first byte is the lowest");

// Spreads eight bits to bytes: bit i becomes bit 0 of byte i.
consteval std::array<std::uint64_t, 256> bytes_of_bits() {
  std::array<std::uint64_t, 256> bytes{};
  for (std::size_t bits = 0; bits < bytes.size(); ++bits) {
    for (std::size_t i = 0; i < evidence::kGroupCells; ++i) {
      bytes[bits] |= std::uint64_t{bits >> i & 1} << (8 * i);
    }
  }
  return bytes;
}
constexpr std::array<std::uint64_t, 256> kBytes = bytes_of_bits();

constexpr std::uint64_t kEightAnywhere = 0x0101010101010101U * decision::kAnywhere;

}  // namespace

void rule_out(const TileMask& mask, window::TileRuledOut& to) {
  static_assert(decision::kBuilding == 1 && decision::kRoad == 2 && decision::kIntermediate == 4);
  for (std::size_t row = 0; row < mask.road.size(); ++row) {
    for (std::size_t i = 0; i < window::kGroupsPerRow; ++i) {
      const auto bytes = [i](std::uint32_t bits) { return kBytes[bits >> (8 * i) & 0xFF]; };
      const std::uint64_t ruled_out =
          kEightAnywhere & ~(bytes(mask.building[row]) | bytes(mask.road[row]) << 1 |
                             bytes(mask.intermediate[row]) << 2);
      __builtin_memcpy(to[row * window::kGroupsPerRow + i].data(), &ruled_out, sizeof ruled_out);
    }
  }
}

}  // namespace iog::map
