#include "stream/tiles.hpp"

#include "require/require.hpp"
#include "wire/byte_order.hpp"
#include "wire/byte_writer.hpp"

namespace iog::stream {
namespace {

constexpr std::size_t kFirstTileOffset = 0;
constexpr std::size_t kEndTileOffset = 2;
constexpr std::size_t kTileCountOffset = 4;

void write_geometry(const Geometry& geometry, std::uint16_t epsilon_e5,
                    std::span<std::byte, kTilesHeaderBytes> header) {
  wire::ByteWriter out(header);
  out.zeros(kTileCountOffset + 2);
  out.u8(geometry.tile_side_log2);
  out.u8(static_cast<std::uint8_t>(geometry.storage));
  out.u16_be(geometry.width);
  out.u16_be(geometry.height);
  out.u16_be(geometry.cell_mm);
  out.u16_be(geometry.storage == Storage::kClass ? std::uint16_t{0} : epsilon_e5);
  out.i32_be(geometry.origin_x_mm);
  out.i32_be(geometry.origin_y_mm);
}

bool is_a_grid(const Geometry& geometry) {
  if (geometry.tile_side_log2 > tile_coding::kTileSideLog2) {
    return false;
  }
  const std::uint32_t within_tile = (1U << geometry.tile_side_log2) - 1;
  return ((geometry.width | geometry.height) & within_tile) == 0;
}

bool are_sound(const TilesHeader& header, TileRecords records, std::size_t bytes) {
  const std::size_t raw_bytes = std::size_t{1} << (2 * header.geometry.tile_side_log2);
  const std::size_t record_bytes = header.window ? kClassTileRecordBytes : kTileRecordBytes;
  std::uint32_t lowest = header.first_tile;
  std::uint32_t count = 0;
  std::size_t read = 0;
  for (TileRecord record; records.next(record); ++count) {
    if (record.tile < lowest || record.tile >= header.end_tile ||
        record.payload.size() > raw_bytes) {
      return false;
    }
    lowest = record.tile + 1U;
    read += record_bytes + record.payload.size();
  }
  return count == header.tile_count && read == bytes;
}

}  // namespace

void TilesWriter::begin_grid(const Header& header, const Geometry& geometry) {
  require(geometry.storage != Storage::kClass);
  write_head(header, geometry);
  records_ = kRecords;
  begin_message(0);
}

void TilesWriter::begin_classes(const Header& header, const ClassWindow& window,
                                std::uint16_t cell_mm, window::Extent extent) {
  write_head(header, geometry_of_classes(cell_mm, extent));
  for (Buffer& buffer : buffers_) {
    write_class_window(window, std::span(buffer.message).subspan<kRecords, kClassWindowBytes>());
  }
  records_ = kRecords + kClassWindowBytes;
  begin_message(0);
}

void TilesWriter::write_head(const Header& header, const Geometry& geometry) {
  Header of_tiles = header;
  of_tiles.type = MessageType::kTiles;
  for (Buffer& buffer : buffers_) {
    const std::span content = std::span(buffer.message).subspan<kContent>();
    write_header(of_tiles, content);
    write_geometry(geometry, header.epsilon_e5, content.subspan<kHeaderBytes, kTilesHeaderBytes>());
  }
}

void TilesWriter::begin_message(std::size_t first_tile) {
  first_tile_ = static_cast<std::uint16_t>(first_tile);
  tile_count_ = 0;
  bytes_ = records_;
}

tile_coding::MutableTileCells TilesWriter::raw_place() {
  static_assert(kRawPayload + kTileRecordBytes + 2 * tile_coding::kTileBytes >
                protection::kMaxMessageBytes);
  require(records_ == kRecords);
  Buffer& buffer = buffers_[tile_count_ == 0 ? current_ : 1 - current_];
  return std::span(buffer.message).subspan<kRawPayload, tile_coding::kTileBytes>();
}

bool TilesWriter::append(std::size_t tile, Encoding encoding, std::span<const std::byte> payload) {
  require(records_ == kRecords);
  return append_record(tile, encoding, std::nullopt, payload);
}

bool TilesWriter::append(std::size_t tile, Encoding encoding, std::uint8_t age_frames,
                         std::span<const std::byte> payload) {
  require(records_ != kRecords);
  return append_record(tile, encoding, age_frames, payload);
}

bool TilesWriter::append_record(std::size_t tile, Encoding encoding,
                                std::optional<std::uint8_t> age,
                                std::span<const std::byte> payload) {
  wire::ByteWriter out{message().subspan(bytes_)};
  out.u16_be(static_cast<std::uint16_t>(tile));
  out.u8(static_cast<std::uint8_t>(encoding));
  if (age) {
    out.u8(*age);
  }
  out.u16_be(static_cast<std::uint16_t>(payload.size()));
  if (payload.data() == out.written().data() + out.written().size()) {
    out.skip(payload.size());
  } else {
    out.bytes(payload);
  }
  if (!out.ok()) {
    require(tile_count_ > 0);
    return false;
  }
  bytes_ += out.written().size();
  ++tile_count_;
  return true;
}

std::span<std::byte> TilesWriter::finish(std::size_t end_tile, std::uint32_t sequence) {
  const std::span finished = message().first(bytes_);
  set_sequence(finished.subspan<kContent, kHeaderBytes>(), sequence);
  const std::span header = finished.subspan<kContent + kHeaderBytes, kTilesHeaderBytes>();
  wire::store_be16(header.subspan<kFirstTileOffset, 2>(), first_tile_);
  wire::store_be16(header.subspan<kEndTileOffset, 2>(), static_cast<std::uint16_t>(end_tile));
  wire::store_be16(header.subspan<kTileCountOffset, 2>(), tile_count_);
  current_ = 1 - current_;
  begin_message(end_tile);
  return finished;
}

bool TileRecords::next(TileRecord& record) {
  if (in_.remaining() == 0) {
    return false;
  }
  record.tile = in_.u16_be();
  record.encoding = static_cast<Encoding>(in_.u8());
  record.age_frames = have_age_ ? in_.u8() : std::uint8_t{0};
  record.payload = in_.bytes(in_.u16_be());
  return in_.ok();
}

ReadStatus read_tiles(std::span<const std::byte> body, TilesHeader& header, TileRecords& records) {
  wire::ByteReader in(body);
  header.first_tile = in.u16_be();
  header.end_tile = in.u16_be();
  header.tile_count = in.u16_be();
  header.geometry.tile_side_log2 = in.u8();
  header.geometry.storage = static_cast<Storage>(in.u8());
  header.geometry.width = in.u16_be();
  header.geometry.height = in.u16_be();
  header.geometry.cell_mm = in.u16_be();
  header.epsilon_e5 = in.u16_be();
  header.geometry.origin_x_mm = in.i32_be();
  header.geometry.origin_y_mm = in.i32_be();
  header.window.reset();
  if (header.geometry.storage == Storage::kClass &&
      !read_class_window(in, header.window.emplace())) {
    return ReadStatus::kTooShort;
  }
  if (!in.ok()) {
    return ReadStatus::kTooShort;
  }
  const std::span tiles = body.last(in.remaining());
  records = TileRecords(header.geometry.storage, tiles);
  const bool speaks_of_its_grid = is_a_grid(header.geometry) &&
                                  header.first_tile <= header.end_tile &&
                                  header.end_tile <= header.geometry.tile_count();
  return speaks_of_its_grid && are_sound(header, records, tiles.size()) ? ReadStatus::kOk
                                                                        : ReadStatus::kInconsistent;
}

}  // namespace iog::stream
