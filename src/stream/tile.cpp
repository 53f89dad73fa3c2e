#include "stream/tile.hpp"

#include <array>

namespace iog::stream {
namespace {

// Of any tile of the grid, but for its place.
constexpr TileHeader raw_tile_header() {
  constexpr std::int32_t kOriginMm = -vehicle::kOriginCell * vehicle::kCellMm;
  return {.side_log2 = kTileSideLog2,
          .encoding = Encoding::kRaw,
          .storage = Storage::kOccupancyIndex,
          .grid_width = vehicle::kCellsPerSide,
          .grid_height = vehicle::kCellsPerSide,
          .cell_mm = vehicle::kCellMm,
          .payload_bytes = kTileBytes,
          .origin_x_mm = kOriginMm,
          .origin_y_mm = kOriginMm};
}

}  // namespace

void GridHash::add(std::size_t tile_x, std::size_t tile_y,
                   std::span<const std::byte, kTileBytes> tile) {
  std::array<std::byte, 4> place{};
  wire::store_be16(std::span(place).first<2>(), static_cast<std::uint16_t>(tile_x));
  wire::store_be16(std::span(place).last<2>(), static_cast<std::uint16_t>(tile_y));
  crc_.update(place);
  crc_.update(tile);
}

TileMessage::TileMessage(const Header& header) {
  Header of_tiles = header;
  of_tiles.type = MessageType::kTile;
  write_header(of_tiles, message_.header);
  write_tile_header(raw_tile_header(), message_.tile_header);
}

void TileMessage::set_tile(std::size_t tile_x, std::size_t tile_y) {
  stream::set_tile(message_.tile_header, tile_x, tile_y);
}

}  // namespace iog::stream
