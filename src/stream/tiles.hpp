// The message of tiles: which tiles of a grid it speaks of, and the content of those in which
// something is known (docs/spec.md 3.3). A tile that it speaks of but does not contain is unknown.
// So the messages of a frame that have arrived say what is known, what is unknown, and what is
// missing.
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

// The values are on the wire.
enum class Storage : std::uint8_t {
  kOccupancyIndex = 0,  // of a cell
  kHighestIndex = 1,    // of the cells below a coarse cell
  kClass = 2,           // of a cell of the world-aligned window (stream/class_window.hpp)
};

// What a message of tiles says of its grid.
struct Geometry {
  std::uint8_t tile_side_log2 = 0;  // cells
  Storage storage = Storage::kOccupancyIndex;
  std::uint16_t width = 0;   // cells, a multiple of a tile's side
  std::uint16_t height = 0;  // cells, a multiple of a tile's side
  std::uint16_t cell_mm = 0;
  // The corner of lowest x and y in the vehicle frame; of classes 0, because their window says it.
  std::int32_t origin_x_mm = 0;
  std::int32_t origin_y_mm = 0;

  [[nodiscard]] constexpr std::uint32_t tile_count() const {
    return (std::uint32_t{width} >> tile_side_log2) * (std::uint32_t{height} >> tile_side_log2);
  }

  friend constexpr bool operator==(const Geometry&, const Geometry&) = default;
};

// The grid of this firmware at a level of its quadtree, from 0 (its cells) to 5 (one coarse cell a
// tile).
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

// The window of this firmware: as many cells as its grid.
[[nodiscard]] constexpr Geometry geometry_of_classes() {
  Geometry geometry = geometry_of_level(0);
  geometry.storage = Storage::kClass;
  geometry.origin_x_mm = 0;
  geometry.origin_y_mm = 0;
  return geometry;
}

struct TilesHeader {
  std::uint16_t first_tile = 0;  // that the message speaks of
  std::uint16_t end_tile = 0;    // the one behind the last
  std::uint16_t tile_count = 0;  // of them that follow
  Geometry geometry;
  std::optional<ClassWindow> window{};  // of classes
};
inline constexpr std::size_t kTilesHeaderBytes = 24;
inline constexpr std::size_t kTileRecordBytes = 5;       // before the payload
inline constexpr std::size_t kClassTileRecordBytes = 6;  // likewise, with the tile's age
static_assert(protection::kProtectionBytes + kHeaderBytes + kTilesHeaderBytes + kClassWindowBytes +
                  kClassTileRecordBytes + tile_coding::kTileBytes <=
              protection::kMaxMessageBytes);

// Composes one message of tiles after the other. In front of each it leaves room for the header
// that protects it.
class TilesWriter {
 public:
  // Begins a grid and its first message, from tile 0 on. `header` is the frame's; its type and
  // sequence number do not matter.
  void begin_grid(const Header& header, const Geometry& geometry);
  // The same of classes. Tiles are numbered by window::slot_of().
  void begin_classes(const Header& header, const ClassWindow& window);
  // Begins the message again, from another tile on.
  void begin_message(std::size_t first_tile);

  // Appends a tile with a higher number than the one before. False, and nothing is changed, if
  // there is no room for it. A message without tiles always has room, even for a raw tile.
  [[nodiscard]] bool append(std::size_t tile, Encoding encoding,
                            std::span<const std::byte> payload);
  // The same of classes. age_frames: since the tile was decided, 255: or longer.
  [[nodiscard]] bool append(std::size_t tile, Encoding encoding, std::uint8_t age_frames,
                            std::span<const std::byte> payload);

  // Ends the message, which speaks of the tiles up to but not including `end_tile`; the next one
  // begins there. The bytes are valid until append() or a begin function is called.
  [[nodiscard]] std::span<std::byte> finish(std::size_t end_tile, std::uint32_t sequence);

  // Tiles in the message that is being composed.
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
  Encoding encoding = Encoding::kRaw;  // any value may come
  std::uint8_t age_frames = 0;         // of classes: since it was decided, 255: or longer
  std::span<const std::byte> payload{};
};

// The tiles of a message that read_tiles() has found sound, one after the other.
class TileRecords {
 public:
  TileRecords() = default;
  TileRecords(Storage storage, std::span<const std::byte> records)
      : have_age_{storage == Storage::kClass}, in_{records} {}

  // False after the last one.
  [[nodiscard]] bool next(TileRecord& record);

 private:
  bool have_age_ = false;
  wire::ByteReader in_{{}};
};

// Reads a body of tiles. kOk, kTooShort, or kInconsistent: the message speaks of tiles that its
// grid does not have; or it contains a tile that it does not speak of, the same tile twice, a tile
// longer than a raw one, or not as many tiles as it says.
[[nodiscard]] ReadStatus read_tiles(std::span<const std::byte> body, TilesHeader& header,
                                    TileRecords& records);

}  // namespace iog::stream
