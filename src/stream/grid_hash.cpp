#include "stream/grid_hash.hpp"

#include <array>
#include <span>

#include "geometry/grid.hpp"
#include "wire/byte_order.hpp"

namespace iog::stream {

void GridHash::add(std::size_t tile, tile_coding::TileCells cells) {
  add_remainder(tile, GridCrc32::remainder_of(cells));
}

void GridHash::add_remainder(std::size_t tile, std::uint32_t remainder) {
  const std::size_t x = tile % geometry::kTilesPerSide;
  const std::size_t y = tile / geometry::kTilesPerSide;
  std::array<std::byte, 4> place{};
  wire::store_be16(std::span(place).first<2>(), static_cast<std::uint16_t>(x));
  wire::store_be16(std::span(place).last<2>(), static_cast<std::uint16_t>(y));
  crc_.add_remainder(std::span<const std::byte, 4>(place), remainder);
}

}  // namespace iog::stream
