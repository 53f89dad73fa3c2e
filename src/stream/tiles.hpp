// The message of tiles (docs/spec.md 3.3): the range of tile numbers that it covers, and the
// content of the known tiles among them. A covered tile without content is unknown. A receiver can
// therefore tell known, unknown and missing tiles apart.
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

// Wire values.
enum class Storage : std::uint8_t {
  kOccupancyIndex = 0,  // the index of each cell
  kHighestIndex = 1,    // the highest index within each coarse cell
  kClass = 2,  // the class of each cell of the world-aligned window (stream/class_window.hpp)
};

// Describes the grid of a message of tiles.
struct Geometry {
  std::uint8_t tile_side_log2 = 0;  // cells
  Storage storage = Storage::kOccupancyIndex;
  std::uint16_t width = 0;   // cells, a multiple of a tile's side
  std::uint16_t height = 0;  // cells, a multiple of a tile's side
  std::uint16_t cell_mm = 0;
  // The corner of lowest x and y in the vehicle frame. 0 for classes: the window header gives it.
  std::int32_t origin_x_mm = 0;
  std::int32_t origin_y_mm = 0;

  [[nodiscard]] constexpr std::uint32_t tile_count() const {
    return (std::uint32_t{width} >> tile_side_log2) * (std::uint32_t{height} >> tile_side_log2);
  }

  friend constexpr bool operator==(const Geometry&, const Geometry&) = default;
};

// The grid of this firmware at a level of its quadtree: 0 for its cells, up to 5 for one coarse
// cell per tile.
[[nodiscard]] constexpr Geometry geometry_of_level(unsigned level) {
  constexpr std::int32_t kOriginMm = -geometry::kOriginCell * geometry::kCellMm;
  constexpr auto kSide = static_cast<std::uint32_t>(geometry::kCellsPerSide);
  constexpr auto kCell = static_cast<std::uint32_t>(geometry::kCellMm);
  return {.tile_side_log2 = tile_coding::kTileSideLog2,
          .storage = level == 0 ? Storage::kOccupancyIndex : Storage::kHighestIndex,
          .width = static_cast<std::uint16_t>(kSide >> level),
          .height = static_cast<std::uint16_t>(kSide >> level),
          .cell_mm = static_cast<std::uint16_t>(kCell << level),
          .origin_x_mm = kOriginMm,
          .origin_y_mm = kOriginMm};
}

// The window of this firmware, with as many cells as the grid.
[[nodiscard]] constexpr Geometry geometry_of_classes() {
  Geometry geometry = geometry_of_level(0);
  geometry.storage = Storage::kClass;
  geometry.origin_x_mm = 0;
  geometry.origin_y_mm = 0;
  return geometry;
}

struct TilesHeader {
  std::uint16_t first_tile = 0;  // the first tile that the message covers
  std::uint16_t end_tile = 0;    // one past the last tile that it covers
  std::uint16_t tile_count = 0;  // tiles with content in this message
  Geometry geometry;
  std::optional<ClassWindow> window{};  // for classes only
};
inline constexpr std::size_t kTilesHeaderBytes = 24;
inline constexpr std::size_t kTileRecordBytes = 5;       // before each payload
inline constexpr std::size_t kClassTileRecordBytes = 6;  // the same with the tile's age
static_assert(protection::kProtectionBytes + kHeaderBytes + kTilesHeaderBytes + kClassWindowBytes +
                  kClassTileRecordBytes + tile_coding::kTileBytes <=
              protection::kMaxMessageBytes);

// Composes messages of tiles one by one. Leaves room for the protection header in front of each.
class TilesWriter {
 public:
  // Begins a grid and its first message, at tile 0. `header` is the frame's header; its type and
  // sequence number are ignored.
  void begin_grid(const Header& header, const Geometry& geometry);
  // Begins a grid of classes. Tiles are numbered by window::slot_of().
  void begin_classes(const Header& header, const ClassWindow& window);
  // Discards the tiles of this message and begins it again at another tile.
  void begin_message(std::size_t first_tile);

  // Appends a tile; tile numbers must ascend. Returns false and changes nothing if the tile does
  // not fit. An empty message always has room, even for a raw tile.
  [[nodiscard]] bool append(std::size_t tile, Encoding encoding,
                            std::span<const std::byte> payload);
  // Appends a tile of classes. age_frames: frames since the tile was classified; 255: or more.
  [[nodiscard]] bool append(std::size_t tile, Encoding encoding, std::uint8_t age_frames,
                            std::span<const std::byte> payload);

  // Ends the message, which covers the tiles below `end_tile`, and begins the next one there. The
  // bytes are valid until the next append() or begin function.
  [[nodiscard]] std::span<std::byte> finish(std::size_t end_tile, std::uint32_t sequence);

  // Tiles in the current message.
  [[nodiscard]] std::uint16_t tile_count() const { return tile_count_; }

 private:
  static constexpr std::size_t kContent = protection::kProtectionBytes;
  static constexpr std::size_t kTilesHeader = kContent + kHeaderBytes;
  static constexpr std::size_t kRecords = kTilesHeader + kTilesHeaderBytes;

  void write_head(const Header& header, const Geometry& geometry);
  [[nodiscard]] bool append_record(std::size_t tile, Encoding encoding,
                                   std::optional<std::uint8_t> age,
                                   std::span<const std::byte> payload);

  alignas(8) std::array<std::byte, protection::kMaxMessageBytes> message_{};
  std::size_t records_ = kRecords;  // where the tiles begin
  std::size_t bytes_ = kRecords;
  std::uint16_t first_tile_ = 0;
  std::uint16_t tile_count_ = 0;
};

struct TileRecord {
  std::uint16_t tile = 0;
  Encoding encoding = Encoding::kRaw;  // may have any value
  std::uint8_t age_frames = 0;  // classes only: frames since the tile was classified; 255: or more
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

// Reads a body of tiles. Returns kOk, kTooShort or kInconsistent. kInconsistent means one of: the
// message covers tiles outside its grid; it contains a tile that it does not cover, a repeated tile
// or a tile longer than a raw one; the number of tiles is wrong.
[[nodiscard]] ReadStatus read_tiles(std::span<const std::byte> body, TilesHeader& header,
                                    TileRecords& records);

}  // namespace iog::stream
