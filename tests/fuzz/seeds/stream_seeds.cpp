// Seeds of what reads messages of the stream.
#include <array>
#include <cstdint>

#include "protection/protected_message.hpp"
#include "seeds.hpp"
#include "stream/class_end.hpp"
#include "stream/objects.hpp"
#include "stream/receptions.hpp"
#include "stream/tiles.hpp"

namespace iog::fuzz {
namespace {

Bytes end_content(std::uint32_t frame_number) {
  Bytes head(stream::kHeaderBytes);
  static_cast<void>(stream::write_header({.type = stream::MessageType::kFrameEnd,
                                          .sequence = 2 * frame_number + 1,
                                          .frame_number = frame_number,
                                          .closed_us = frame_number,
                                          .sensor_count = 2},
                                         head));
  Bytes end(400);
  end.resize(stream::write_frame_end({.tiles_sent = 1, .link_counter_count = 3}, 2, end));
  return joined(std::move(head), end);
}

Bytes tiles_content(std::uint32_t frame_number, tile_coding::Encoding encoding,
                    const Bytes& payload) {
  stream::TilesWriter writer;
  writer.begin_grid({.frame_number = frame_number, .closed_us = frame_number},
                    stream::geometry_of_level(0));
  static_cast<void>(writer.append(3, encoding, payload));
  const auto message = writer.finish(geometry::kTileCount, 2 * frame_number);
  return {message.begin() + protection::kProtectionBytes, message.end()};
}

constexpr stream::ClassWindow kWindow{
    .causes = stream::kCauseLate, .corner_a = -3, .corner_b = 70, .slices = 2, .slice_ms = 8};

stream::Header header_of_classes(stream::MessageType type, std::uint32_t sequence) {
  return {.type = type,
          .flags = stream::kFlagClasses | stream::kFlagNoIndexes,
          .sequence = sequence,
          .frame_number = 5};
}

Bytes class_end_content() {
  Bytes head(stream::kHeaderBytes);
  static_cast<void>(
      stream::write_header(header_of_classes(stream::MessageType::kClassEnd, 11), head));
  Bytes end(protection::kMaxContentBytes);
  end.resize(stream::write_class_end({.window = kWindow, .tiles_sent = 1, .slice_count = 2}, end));
  return joined(std::move(head), end);
}

// Two parts of a list.
Bytes objects_content(std::size_t part, std::uint32_t sequence) {
  stream::ObjectList list{.time_us = 5, .count = 33};
  for (std::size_t i = 0; i < list.count; ++i) {
    list.records.at(i) = {.id = static_cast<std::uint32_t>(i) + 1};
  }
  list.records[0].state = stream::ObjectState::kMoves;
  list.records[0].sigma_v_along_cm_s = list.records[0].sigma_v_across_cm_s = 20;
  stream::Header header = header_of_classes(stream::MessageType::kObjects, sequence);
  header.flags |= stream::kFlagObjects;
  Bytes head(stream::kHeaderBytes);
  static_cast<void>(stream::write_header(header, head));
  Bytes body(protection::kMaxContentBytes);
  body.resize(stream::write_objects(list, part, body));
  return joined(std::move(head), body);
}

Bytes receptions_content() {
  stream::Header header = header_of_classes(stream::MessageType::kReceptions, 12);
  header.flags |= stream::kFlagReceptions;
  Bytes head(stream::kHeaderBytes);
  static_cast<void>(stream::write_header(header, head));
  const std::array<stream::Reception, 2> list{
      {{.port = 12002, .key = 7, .before_close_us = 30'000}, {.port = 15010, .was_left = true}}};
  Bytes body(protection::kMaxContentBytes);
  body.resize(stream::write_receptions(list, 0, 0, body));
  return joined(std::move(head), body);
}

Bytes classes_content() {
  stream::TilesWriter writer;
  writer.begin_classes(header_of_classes(stream::MessageType::kTiles, 10), kWindow);
  static_cast<void>(writer.append(3, tile_coding::Encoding::kRaw, 2, Bytes(1024, std::byte{33})));
  const auto message = writer.finish(geometry::kTileCount, 10);
  return {message.begin() + protection::kProtectionBytes, message.end()};
}

}  // namespace

// Two frames of one tile, the second against the first.
void add_stream_seeds(Seeds& seeds) {
  const Bytes raw(1024, std::byte{3});
  const Bytes since{std::byte{1}, std::byte{0}};
  const Bytes first = tiles_content(5, tile_coding::Encoding::kRaw, raw);
  const Bytes second = tiles_content(6, tile_coding::Encoding::kRunStartsSince, since);
  seeds.add("stream_message", first);
  seeds.add("stream_message", end_content(5));
  seeds.add("stream_message", classes_content());
  seeds.add("stream_message", class_end_content());
  seeds.add("stream_message", objects_content(0, 0));
  seeds.add("stream_message", receptions_content());
  for (const char* target : {"frame_assembler", "client_reader"}) {
    seeds.add(target, joined(joined(piece_of(classes_content()), piece_of(class_end_content())),
                             piece_of(end_content(6))));
    seeds.add(target, joined(piece_of(objects_content(0, 0)), piece_of(objects_content(1, 1))));
    seeds.add(target, joined(joined(piece_of(first), piece_of(end_content(5))),
                             joined(piece_of(second), piece_of(end_content(6)))));
  }
  seeds.add("serial_line",
            joined(piece_of(first), piece_of(tiles_content(6, tile_coding::Encoding::kRaw, raw))));
}

}  // namespace iog::fuzz
