#include "stream/tile.hpp"

#include <algorithm>
#include <array>

namespace iog::stream {
namespace {

constexpr std::size_t first_cell(std::size_t tile_x, std::size_t tile_y) {
  return tile_y * kTileSide * grid::kStride + tile_x * kTileSide;
}

}  // namespace

// Every cell of a column is gathered in a lane of its own: the compiler makes two NEON registers of
// the lanes, and a row costs two loads.
bool is_known(std::span<const index::OccupancyIndex, grid::kCellCount> cells, std::size_t tile_x,
              std::size_t tile_y) {
  const auto rows = cells.subspan(first_cell(tile_x, tile_y));
  std::array<index::OccupancyIndex, kTileSide> lanes{};
  for (std::size_t row = 0; row < kTileSide; ++row) {
    const auto row_cells = rows.subspan(row * grid::kStride).first<kTileSide>();
    for (std::size_t x = 0; x < kTileSide; ++x) {
      lanes[x] = static_cast<index::OccupancyIndex>(lanes[x] | row_cells[x]);
    }
  }
  return std::ranges::any_of(lanes, [](index::OccupancyIndex lane) { return lane != 0; });
}

void copy_tile(std::span<const index::OccupancyIndex, grid::kCellCount> cells, std::size_t tile_x,
               std::size_t tile_y, TileBytes tile) {
  const auto bytes = std::as_bytes(cells).subspan(first_cell(tile_x, tile_y));
  for (std::size_t row = 0; row < kTileSide; ++row) {
    std::ranges::copy(bytes.subspan(row * grid::kStride).first<kTileSide>(),
                      tile.subspan(row * kTileSide).begin());
  }
}

void clear_tile(GridCells cells, std::size_t tile_x, std::size_t tile_y) {
  const auto rows = cells.subspan(first_cell(tile_x, tile_y));
  for (std::size_t row = 0; row < kTileSide; ++row) {
    std::ranges::fill(rows.subspan(row * grid::kStride).first<kTileSide>(), index::kUnknown);
  }
}

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
