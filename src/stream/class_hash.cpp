#include "stream/class_hash.hpp"

#include <array>
#include <span>

#include "wire/byte_order.hpp"

namespace iog::stream {

ClassHash::ClassHash(window::TileNumber corner) {
  std::array<std::byte, 8> place{};
  wire::store_be32(std::span(place).first<4>(), static_cast<std::uint32_t>(corner.a));
  wire::store_be32(std::span(place).last<4>(), static_cast<std::uint32_t>(corner.b));
  crc_.update(place);
}

void ClassHash::add(std::size_t number, tile_coding::TileCells cells) {
  add_remainder(number, GridCrc32::remainder_of(cells));
}

void ClassHash::add_remainder(std::size_t number, std::uint32_t remainder) {
  std::array<std::byte, 2> place{};
  wire::store_be16(place, static_cast<std::uint16_t>(number));
  crc_.add_remainder(std::span<const std::byte, 2>(place), remainder);
  is_empty_ = false;
}

}  // namespace iog::stream
