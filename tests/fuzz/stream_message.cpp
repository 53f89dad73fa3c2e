// The readers of the messages that carry a grid.
#include <array>

#include "law.hpp"
#include "stream/tiles.hpp"

namespace iog::fuzz {
namespace {

using Buffer = std::array<std::byte, protection::kMaxContentBytes>;

// The fields that we know, written again and read again, are written the same once more.
template <typename Part, typename Read, typename Write>
void check_again(const Part& part, Read read, Write write) {
  Buffer once{};
  const std::size_t bytes = write(part, once);
  law(bytes > 0, "what was read can be written");
  Part again{};
  law(read(std::span(once).first(bytes), again), "and read");
  Buffer twice{};
  law(write(again, twice) == bytes && once == twice, "and is the same");
}

void check_tiles(std::span<const std::byte> body) {
  stream::TilesHeader header;
  stream::TileRecords records;
  if (stream::read_tiles(body, header, records) != stream::ReadStatus::kOk) {
    return;
  }
  std::size_t bytes = stream::kTilesHeaderBytes;
  std::uint32_t lowest = header.first_tile;
  std::uint32_t count = 0;
  for (stream::TileRecord record; records.next(record); ++count) {
    law(record.tile >= lowest && record.tile < header.end_tile, "tiles rise");
    lowest = record.tile + 1U;
    bytes += stream::kTileRecordBytes + record.payload.size();
  }
  law(bytes == body.size() && count == header.tile_count, "tiles are as long as they say");
  law(header.end_tile <= header.geometry.tile_count(), "and lie in their grid");
}

void check_content(std::span<const std::byte> message) {
  stream::Header header;
  std::span<const std::byte> body;
  if (stream::read_header(message, header, body) != stream::ReadStatus::kOk) {
    return;
  }
  law(body.size() + stream::kHeaderBytes <= message.size(), "the body is behind the header");
  check_tiles(body);
  check_again(
      header,
      [](std::span<const std::byte> bytes, stream::Header& part) {
        std::span<const std::byte> rest;
        return stream::read_header(bytes, part, rest) == stream::ReadStatus::kOk;
      },
      [](const stream::Header& part, Buffer& buffer) {
        return stream::write_header(part, buffer);
      });
  stream::FrameEnd end;
  if (header.sensor_count <= vehicle::kMaxSensors &&
      stream::read_frame_end(body, header.sensor_count, end) == stream::ReadStatus::kOk) {
    check_again(
        end,
        [&](std::span<const std::byte> bytes, stream::FrameEnd& part) {
          return stream::read_frame_end(bytes, header.sensor_count, part) ==
                 stream::ReadStatus::kOk;
        },
        [&](const stream::FrameEnd& part, Buffer& buffer) {
          return stream::write_frame_end(part, header.sensor_count, buffer);
        });
  }
}

}  // namespace
}  // namespace iog::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  iog::fuzz::check_content(iog::fuzz::input_bytes(data, size));
  return 0;
}
