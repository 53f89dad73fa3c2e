#include "stream/grid_hash.hpp"

#include <array>

#include "wire/byte_order.hpp"

namespace iog::stream {

void GridHash::add(std::size_t tile_x, std::size_t tile_y,
                   std::span<const std::byte, tile_coding::kTileBytes> tile) {
  std::array<std::byte, 4> place{};
  wire::store_be16(std::span(place).first<2>(), static_cast<std::uint16_t>(tile_x));
  wire::store_be16(std::span(place).last<2>(), static_cast<std::uint16_t>(tile_y));
  crc_.update(place);
  crc_.update(tile);
}

}  // namespace iog::stream
