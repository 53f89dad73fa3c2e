// The readers of the messages that carry a grid.
#include <algorithm>
#include <array>

#include "law.hpp"
#include "stream/class_end.hpp"
#include "stream/objects.hpp"
#include "stream/receptions.hpp"
#include "stream/tiles.hpp"
#include "wire/byte_order.hpp"

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

void check_window(const stream::ClassWindow& classes) {
  std::array<std::byte, stream::kClassWindowBytes> bytes{};
  stream::write_class_window(classes, bytes);
  wire::ByteReader in(bytes);
  stream::ClassWindow again;
  law(stream::read_class_window(in, again) && again == classes, "a window survives the wire");
  for (std::size_t slot = 0; slot < geometry::kTileCount; slot += 37) {
    const window::TileNumber tile = stream::area_of(classes).tile_at(slot);
    law(window::slot_of(tile) == slot, "a tile has the number of its place");
  }
}

void check_tiles(std::span<const std::byte> body) {
  stream::TilesHeader header;
  stream::TileRecords records;
  if (stream::read_tiles(body, header, records) != stream::ReadStatus::kOk) {
    return;
  }
  law(header.window.has_value() == (header.geometry.storage == stream::Storage::kClass),
      "classes have a window, and nothing else has");
  const std::size_t record_bytes =
      header.window ? stream::kClassTileRecordBytes : stream::kTileRecordBytes;
  std::size_t bytes = stream::kTilesHeaderBytes;
  if (header.window) {
    // The window's header may be longer than we know it.
    bytes += wire::load_be16(body.subspan<stream::kTilesHeaderBytes, 2>());
    check_window(*header.window);
  }
  std::uint32_t lowest = header.first_tile;
  std::uint32_t count = 0;
  for (stream::TileRecord record; records.next(record); ++count) {
    law(record.tile >= lowest && record.tile < header.end_tile, "tiles rise");
    lowest = record.tile + 1U;
    bytes += record_bytes + record.payload.size();
  }
  law(bytes == body.size() && count == header.tile_count, "tiles are as long as they say");
  law(header.end_tile <= header.geometry.tile_count(), "and lie in their grid");
}

void check_class_end(std::span<const std::byte> body) {
  stream::ClassEnd end;
  if (stream::read_class_end(body, end) != stream::ReadStatus::kOk) {
    return;
  }
  law(end.slice_count <= stream::kMaxSlices, "slices have room");
  check_window(end.window);
  check_again(
      end,
      [](std::span<const std::byte> bytes, stream::ClassEnd& part) {
        return stream::read_class_end(bytes, part) == stream::ReadStatus::kOk;
      },
      [](const stream::ClassEnd& part, Buffer& buffer) {
        return stream::write_class_end(part, buffer);
      });
}

void check_objects(std::span<const std::byte> body) {
  stream::ObjectPart part;
  if (stream::read_objects(body, part) != stream::ReadStatus::kOk) {
    return;
  }
  law(part.part < part.header.parts && part.count <= part.header.objects,
      "a part is one of a list");
  std::uint32_t id_before = 0;
  for (const stream::ObjectRecord& object : part.all()) {
    law(object.id > id_before, "ids rise");
    id_before = object.id;
    law(object.state == stream::ObjectState::kMoves || (object.vx_cm_s == 0 && object.vy_cm_s == 0),
        "only what moves has a speed");
  }
  if (part.header.parts > 1) {
    return;
  }
  stream::ObjectList list{.time_us = part.header.time_us,
                          .tracks_refused = part.header.tracks_refused,
                          .hits_left = part.header.hits_left,
                          .count = part.header.objects};
  std::ranges::copy(part.all(), list.records.begin());
  Buffer once{};
  const std::size_t bytes = stream::write_objects(list, 0, once);
  stream::ObjectPart again;
  law(stream::read_objects(std::span(once).first(bytes), again) == stream::ReadStatus::kOk &&
          again.header == part.header && std::ranges::equal(again.all(), part.all()),
      "a list survives the wire");
}

void check_receptions(std::span<const std::byte> body) {
  stream::ReceptionPart part;
  if (stream::read_receptions(body, part) != stream::ReadStatus::kOk) {
    return;
  }
  law(part.part < part.header.parts && part.count <= part.header.receptions,
      "a part is one of what was received");
  if (part.header.parts > 1) {
    return;
  }
  Buffer once{};
  const std::size_t bytes = stream::write_receptions(part.all(), part.header.not_listed, 0, once);
  stream::ReceptionPart again;
  law(stream::read_receptions(std::span(once).first(bytes), again) == stream::ReadStatus::kOk &&
          again.header == part.header && std::ranges::equal(again.all(), part.all()),
      "what was received survives the wire");
}

}  // namespace

void check(std::span<const std::byte> message) {
  stream::Header header;
  std::span<const std::byte> body;
  if (stream::read_header(message, header, body) != stream::ReadStatus::kOk) {
    return;
  }
  law(body.size() + stream::kHeaderBytes <= message.size(), "the body is behind the header");
  check_tiles(body);
  check_class_end(body);
  check_objects(body);
  check_receptions(body);
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

}  // namespace iog::fuzz
