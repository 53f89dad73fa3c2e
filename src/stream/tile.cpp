#include "stream/tile.hpp"

#include <array>

namespace iog::stream {

void GridHash::add(std::size_t tile_x, std::size_t tile_y,
                   std::span<const std::byte, kTileBytes> tile) {
  std::array<std::byte, 4> place{};
  wire::store_be16(std::span(place).first<2>(), static_cast<std::uint16_t>(tile_x));
  wire::store_be16(std::span(place).last<2>(), static_cast<std::uint16_t>(tile_y));
  crc_.update(place);
  crc_.update(tile);
}

TileHeader raw_tile_header(std::size_t tile_x, std::size_t tile_y) {
  constexpr std::int32_t kOriginMm = -vehicle::kOriginCell * vehicle::kCellMm;
  return {.tile_x = static_cast<std::uint16_t>(tile_x),
          .tile_y = static_cast<std::uint16_t>(tile_y),
          .side_log2 = kTileSideLog2,
          .encoding = Encoding::kRaw,
          .storage = Storage::kOccupancyIndex,
          .grid_width = vehicle::kCellsPerSide,
          .grid_height = vehicle::kCellsPerSide,
          .cell_mm = vehicle::kCellMm,
          .payload_bytes = kTileBytes,
          .origin_x_mm = kOriginMm,
          .origin_y_mm = kOriginMm};
}

}  // namespace iog::stream
