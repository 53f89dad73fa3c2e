#include "stream/grid_hash.hpp"

#include <array>
#include <span>

#include "wire/byte_order.hpp"

namespace iog::stream {

void GridHash::add(std::size_t tile, tile_coding::TileCells cells) {
  add_remainder(tile, GridCrc32::remainder_of(cells));
}

void GridHash::add_remainder(std::size_t tile, std::uint32_t remainder) {
  for (; tile >= row_end_; row_end_ += across_) {
    ++row_;
  }
  std::array<std::byte, 4> place{};
  wire::store_be16(std::span(place).first<2>(),
                   static_cast<std::uint16_t>(tile + across_ - row_end_));
  wire::store_be16(std::span(place).last<2>(), static_cast<std::uint16_t>(row_));
  crc_.add_remainder(std::span<const std::byte, 4>(place), remainder);
}

}  // namespace iog::stream
