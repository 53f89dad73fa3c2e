// The tile message (docs/spec.md 3.3). A tile message contains the range of tile numbers that it
// covers, and the content of the known tiles in this range. If the message has no content for a
// tile in this range, the tile is unknown. A receiver can therefore distinguish known, unknown and
// missing tiles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "geometry/grid.hpp"
#include "protection/protected_message.hpp"
#include "stream/class_window.hpp"
#include "stream/message.hpp"
#include "tile_coding/encode.hpp"
#include "wire/byte_reader.hpp"

namespace iog::stream {

using tile_coding::Encoding;

// The values of this enumeration are part of the wire format.
enum class Storage : std::uint8_t {
  kOccupancyIndex = 0,  // the index of each cell
  kHighestIndex = 1,    // the highest index within each coarse cell
  kClass = 2,  // the class of each cell of the world-aligned window (stream/class_window.hpp)
};

// Describes the grid of a tile message.
struct Geometry {
  std::uint8_t tile_side_log2 = 0;  // log2 of the tile's side in cells
  Storage storage = Storage::kOccupancyIndex;
  std::uint16_t width = 0;   // in cells; a multiple of the tile's side
  std::uint16_t height = 0;  // in cells; a multiple of the tile's side
  std::uint16_t cell_mm = 0;
  // The position of the grid's corner with the lowest x and y, in the vehicle frame. For class
  // grids, both coordinates are 0 because the window header contains the position.
  std::int32_t origin_x_mm = 0;
  std::int32_t origin_y_mm = 0;

  [[nodiscard]] constexpr std::uint32_t tile_count() const {
    return (std::uint32_t{width} >> tile_side_log2) * (std::uint32_t{height} >> tile_side_log2);
  }

  friend constexpr bool operator==(const Geometry&, const Geometry&) = default;
};

// Returns the geometry of one quadtree level of the default grid, with the cell size and the origin
// of `grid`. Level 0 contains the cells, and level 5 contains one coarse cell per tile.
[[nodiscard]] constexpr Geometry geometry_of_level(unsigned level,
                                                   const geometry::Grid& grid = {}) {
  constexpr auto kSide = static_cast<std::uint32_t>(geometry::kCellsPerSide);
  return {.tile_side_log2 = tile_coding::kTileSideLog2,
          .storage = level == 0 ? Storage::kOccupancyIndex : Storage::kHighestIndex,
          .width = static_cast<std::uint16_t>(kSide >> level),
          .height = static_cast<std::uint16_t>(kSide >> level),
          .cell_mm = static_cast<std::uint16_t>(std::uint32_t{grid.cell_mm} << level),
          .origin_x_mm = -grid.origin_column * grid.cell_mm,
          .origin_y_mm = -grid.origin_row * grid.cell_mm};
}

// Returns the geometry of a car's grid.
[[nodiscard]] constexpr Geometry geometry_of(const geometry::Grid& grid) {
  Geometry geometry = geometry_of_level(0, grid);
  geometry.width = grid.columns;
  geometry.height = grid.rows;
  return geometry;
}

// Returns the grid with the given geometry, or std::nullopt if no car can have such a grid.
[[nodiscard]] constexpr std::optional<geometry::Grid> grid_of(const Geometry& geometry) {
  if (!geometry::is_cell_size(geometry.cell_mm)) {
    return std::nullopt;
  }
  const auto cells = [&](std::int64_t mm) {
    return static_cast<std::uint16_t>(mm / geometry.cell_mm);
  };
  const geometry::Grid grid{.cell_mm = geometry.cell_mm,
                            .columns = geometry.width,
                            .rows = geometry.height,
                            .origin_column = cells(-std::int64_t{geometry.origin_x_mm}),
                            .origin_row = cells(-std::int64_t{geometry.origin_y_mm})};
  return grid.fits() && geometry_of(grid) == geometry ? std::optional(grid) : std::nullopt;
}

// Returns the geometry of a window.
[[nodiscard]] constexpr Geometry geometry_of_classes(std::uint16_t cell_mm = geometry::kCellMm,
                                                     window::Extent extent = {}) {
  Geometry geometry = geometry_of_level(0, {.cell_mm = cell_mm});
  geometry.storage = Storage::kClass;
  geometry.width = static_cast<std::uint16_t>(extent.cells().width);
  geometry.height = static_cast<std::uint16_t>(extent.cells().height);
  geometry.origin_x_mm = 0;
  geometry.origin_y_mm = 0;
  return geometry;
}

// Returns the extent of the window with this geometry, or std::nullopt if no car can have such a
// window.
[[nodiscard]] constexpr std::optional<window::Extent> extent_of(const Geometry& geometry) {
  const auto tiles = [](std::uint16_t cells) {
    return static_cast<std::uint8_t>(cells / geometry::kTileSide);
  };
  const window::Extent extent{.columns = tiles(geometry.width), .rows = tiles(geometry.height)};
  const bool fits = geometry::is_cell_size(geometry.cell_mm) && extent.is_allowed() &&
                    geometry_of_classes(geometry.cell_mm, extent) == geometry;
  return fits ? std::optional(extent) : std::nullopt;
}

struct TilesHeader {
  std::uint16_t first_tile = 0;  // the first tile that the message covers
  std::uint16_t end_tile = 0;    // one past the last tile that the message covers
  std::uint16_t tile_count = 0;  // number of tiles with content in this message
  Geometry geometry;
  std::uint16_t epsilon_e5 = 0;         // epsilon of the recursive set in 1e-5; 0 for classes
  std::optional<ClassWindow> window{};  // only for classes
};
inline constexpr std::size_t kTilesHeaderBytes = 24;
inline constexpr std::size_t kTileRecordBytes = 5;       // size of the record before each payload
inline constexpr std::size_t kClassTileRecordBytes = 6;  // the same record with the age of the tile
static_assert(protection::kProtectionBytes + kHeaderBytes + kTilesHeaderBytes + kClassWindowBytes +
                  kClassTileRecordBytes + tile_coding::kTileBytes <=
              protection::kMaxMessageBytes);

// Composes tile messages one at a time, and leaves space for the protection header at the start of
// each message. A caller can write the cells of a raw tile directly into its message.
class TilesWriter {
 public:
  // Starts a grid and begins its first message at tile 0. `header` is the frame's header. Its type
  // and sequence number are ignored.
  void begin_grid(const Header& header, const Geometry& geometry);
  // Starts a class grid. Tiles are numbered as in window/area.hpp.
  void begin_classes(const Header& header, const ClassWindow& window,
                     std::uint16_t cell_mm = geometry::kCellMm, window::Extent extent = {});
  // Discards the tiles of the current message and restarts the message at another tile.
  void begin_message(std::size_t first_tile);

  // Returns the place of the next raw tile's cells if all tiles of the grid are raw. append() does
  // not copy a payload that is already there. The place is aligned to 32 bytes, and keeps its cells
  // and its address until append() accepts a tile.
  [[nodiscard]] tile_coding::MutableTileCells raw_place();

  // Appends a tile. Tile numbers must be in ascending order. If the tile does not fit, returns
  // false and changes nothing. An empty message always has enough space, even for a raw tile.
  [[nodiscard]] bool append(std::size_t tile, Encoding encoding,
                            std::span<const std::byte> payload);
  // Appends a class tile. `age_frames` is the number of frames since the tile was classified. The
  // value 255 means 255 or more.
  [[nodiscard]] bool append(std::size_t tile, Encoding encoding, std::uint8_t age_frames,
                            std::span<const std::byte> payload);

  // Ends the message and starts the next one at `end_tile`. The ended message covers all tiles
  // before `end_tile`. The returned bytes are valid until the next call to raw_place(), append(),
  // begin_message(), begin_grid() or begin_classes().
  [[nodiscard]] std::span<std::byte> finish(std::size_t end_tile, std::uint32_t sequence);

  // Returns the number of tiles in the current message.
  [[nodiscard]] std::uint16_t tile_count() const { return tile_count_; }

 private:
  static constexpr std::size_t kContent = protection::kProtectionBytes;
  static constexpr std::size_t kTilesHeader = kContent + kHeaderBytes;
  static constexpr std::size_t kRecords = kTilesHeader + kTilesHeaderBytes;

  void write_head(const Header& header, const Geometry& geometry);
  [[nodiscard]] bool append_record(std::size_t tile, Encoding encoding,
                                   std::optional<std::uint8_t> age,
                                   std::span<const std::byte> payload);

  // The first raw payload of a message without classes is aligned to 32 bytes.
  static constexpr std::size_t kRawPayload = kRecords + kTileRecordBytes;
  struct Buffer {
    alignas(32) std::array<std::byte, (kRawPayload + 31) / 32 * 32 - kRawPayload> unused;
    std::array<std::byte, protection::kMaxMessageBytes> message;
  };
  static_assert(offsetof(Buffer, message) + kRawPayload == (kRawPayload + 31) / 32 * 32);

  [[nodiscard]] std::span<std::byte, protection::kMaxMessageBytes> message() {
    return buffers_[current_].message;
  }

  // The current message is in one buffer. The other one contains the message before it, until the
  // cells of the next message's tile are put there.
  std::array<Buffer, 2> buffers_{};
  std::size_t current_ = 0;
  std::size_t records_ = kRecords;  // offset of the first tile record
  std::size_t bytes_ = kRecords;
  std::uint16_t first_tile_ = 0;
  std::uint16_t tile_count_ = 0;
};

struct TileRecord {
  std::uint16_t tile = 0;
  Encoding encoding = Encoding::kRaw;  // may contain a value that is not in the enumeration
  std::uint8_t age_frames = 0;  // class tiles only: frames since classification, capped at 255
  std::span<const std::byte> payload{};
};

// Iterates over the tiles of a message that read_tiles() has accepted.
class TileRecords {
 public:
  TileRecords() = default;
  TileRecords(Storage storage, std::span<const std::byte> records)
      : have_age_{storage == Storage::kClass}, in_{records} {}

  // Returns false after the last tile.
  [[nodiscard]] bool next(TileRecord& record);

 private:
  bool have_age_ = false;
  wire::ByteReader in_{{}};
};

// Reads the body of a tile message. Returns kOk, kTooShort or kInconsistent. A message is
// inconsistent in any of these cases:
//   * The message covers tiles outside its grid, or contains a tile that it does not cover.
//   * The message contains a tile twice, or the payload of a tile is longer than that of a raw
//     tile.
//   * The number of tiles is wrong.
[[nodiscard]] ReadStatus read_tiles(std::span<const std::byte> body, TilesHeader& header,
                                    TileRecords& records);

}  // namespace iog::stream
