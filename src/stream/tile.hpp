// Tiles: the squares of 32 by 32 cells in which a grid travels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "grid/block_grid.hpp"
#include "stream/crc32.hpp"
#include "stream/message.hpp"

namespace iog::stream {

// Those of the grid, in bytes and numbers of the wire.
inline constexpr std::uint8_t kTileSideLog2 = 5;
inline constexpr std::size_t kTileSide = grid::kTileSide;
inline constexpr std::size_t kTileBytes = grid::kTileCells;
inline constexpr std::size_t kTilesPerSide = grid::kTilesPerSide;
inline constexpr std::size_t kTileCount = grid::kTileCount;
static_assert(kTileSide == std::size_t{1} << kTileSideLog2);
static_assert(kHeaderBytes + kTileHeaderBytes + kTileBytes <= kMaxMessageBytes);

// The name of a grid: CRC-32 over its known tiles in order of tile y, then tile x, each as u16 tile
// x and u16 tile y, big endian, then its 1024 cells. A grid in which nothing is known has CRC 0.
class GridHash {
 public:
  void add(std::size_t tile_x, std::size_t tile_y, std::span<const std::byte, kTileBytes> tile);
  [[nodiscard]] std::uint32_t value() const { return crc_.value(); }

 private:
  Crc32 crc_;
};

// The message of one tile after the other, raw. What the tiles of a frame have in common is written
// once, and the cells are copied from the grid to where they belong.
class TileMessage {
 public:
  // header: of the frame; its type and sequence number do not matter.
  explicit TileMessage(const Header& header);

  void set_sequence(std::uint32_t sequence) { stream::set_sequence(header(), sequence); }
  void set_tile(std::size_t tile_x, std::size_t tile_y);

  // Where the tile's cells belong, row by row from its lowest y.
  [[nodiscard]] std::span<index::OccupancyIndex, kTileBytes> cells() { return message_.cells; }
  [[nodiscard]] std::span<const std::byte, kTileBytes> cell_bytes() const {
    return std::as_bytes(std::span(message_.cells));
  }

  [[nodiscard]] std::span<const std::byte> bytes() const {
    return std::as_bytes(std::span(&message_, 1));
  }

 private:
  // Aligned as the machine likes to store rows of cells.
  struct alignas(8) Message {
    std::array<std::byte, kHeaderBytes> header{};
    std::array<std::byte, kTileHeaderBytes> tile_header{};
    std::array<index::OccupancyIndex, kTileBytes> cells;
  };
  static_assert(sizeof(Message) == kHeaderBytes + kTileHeaderBytes + kTileBytes);

  [[nodiscard]] std::span<std::byte, kHeaderBytes> header() { return message_.header; }

  Message message_;
};

}  // namespace iog::stream
