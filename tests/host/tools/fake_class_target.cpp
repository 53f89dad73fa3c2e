#include "fake_class_target.hpp"

#include "stream/class_end.hpp"
#include "stream/crc32.hpp"
#include "wire/byte_writer.hpp"

namespace iog::tools {

std::optional<FakeClassWorld::Cells> FakeClassWorld::at(std::int32_t a, std::int32_t b,
                                                        std::uint32_t frame) const {
  tests::Random random(seed * 1'000'003 + static_cast<std::uint64_t>(a * 4096 + b));
  if (random.below(3) != 0) {
    return std::nullopt;
  }
  Cells cells{};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] = i % 100 == 0 || random.one_in(60) ? class_byte(random) : cells[i - 1];
  }
  cells[(random.below(1024) + std::size_t{5} * frame) % cells.size()] = class_byte(random);
  return cells;
}

std::vector<FakeClassWorld::Place> FakeClassWorld::window_in(std::uint32_t frame) const {
  const auto [corner_a, corner_b] = corner_in(frame);
  const auto remainder = [](std::int32_t n, std::int32_t by) {
    return static_cast<std::size_t>((n % by + by) % by);
  };
  const auto [columns, rows] = extent;
  std::vector<Place> places;
  for (std::int32_t b = corner_b; b < corner_b + rows; ++b) {
    for (std::int32_t a = corner_a; a < corner_a + columns; ++a) {
      places.push_back({a, b, remainder(b, 32) * 32 + remainder(a, 32),
                        remainder(b, rows) * columns + remainder(a, columns)});
    }
  }
  return places;
}

std::map<std::size_t, FakeClassWorld::Cells> FakeClassWorld::tiles_in(std::uint32_t frame) const {
  std::map<std::size_t, Cells> tiles;
  for (const Place& place : window_in(frame)) {
    if (const auto cells = at(place.a, place.b, frame)) {
      tiles[place.number] = *cells;
    }
  }
  return tiles;
}

std::uint32_t FakeClassWorld::name_of(std::uint32_t frame) const {
  const auto [corner_a, corner_b] = corner_in(frame);
  std::array<std::byte, 8> place{};
  wire::ByteWriter out(place);
  out.i32_be(corner_a);
  out.i32_be(corner_b);
  stream::GridCrc32 crc;
  crc.update(place);
  for (const auto& [slot, cells] : tiles_in(frame)) {
    wire::ByteWriter number(place);
    number.u16_be(static_cast<std::uint16_t>(slot));
    crc.update(number.written());
    crc.update(cells);
  }
  return crc.value();
}

FakeClassTarget::Messages FakeClassTarget::next(std::uint16_t causes) {
  header_ = {.flags = static_cast<std::uint8_t>(stream::kFlagClasses |
                                                (has_indexes_ ? 0 : stream::kFlagNoIndexes) |
                                                (objects_ ? stream::kFlagObjects : 0)),
             .sequence = header_.sequence,
             .frame_number = frame_,
             .closed_us = 40'000 * std::uint64_t{frame_},
             .sensor_count = 4,
             .complete_sensors = 0xF,
             .run_number = run_number_};
  messages_.clear();
  if (has_indexes_) {
    send_indexes();
  }
  window_ = window_of_frame(causes);
  send_classes();
  send_class_end();
  if (objects_) {
    send_objects();
  }
  send_frame_end();
  ++frame_;
  return messages_;
}

FakeClassTarget::Messages FakeClassTarget::frames(std::uint32_t count) {
  Messages all;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Messages messages = next();
    all.insert(all.end(), messages.begin(), messages.end());
  }
  return all;
}

FakeClassWorld::Cells FakeClassTarget::index_tile(std::size_t tile, std::uint32_t frame) {
  FakeClassWorld::Cells cells{};
  cells.fill(static_cast<std::byte>(1 + (tile + frame) % 100));
  return cells;
}

stream::ClassWindow FakeClassTarget::window_of_frame(std::uint16_t causes) const {
  const auto [corner_a, corner_b] = FakeClassWorld::corner_in(frame_);
  const std::uint64_t end_us = 1'000'000 + 40'000 * std::uint64_t{frame_};
  return {.causes = causes,
          .corner_a = corner_a,
          .corner_b = corner_b,
          .pose = {.x_mm = (corner_a + 16) * 3200, .y_mm = (corner_b + 16) * 3200, .heading = 9},
          .sigma = {20, 30},
          .slices = 5,
          .slice_ms = 8,
          .slices_begin_us = end_us - 40'000,
          .slices_end_us = end_us};
}

void FakeClassTarget::send(std::span<std::byte> message) {
  sender_.protect(message);
  ++header_.sequence;
  messages_.emplace_back(message.begin(), message.end());
}

template <typename Append>
void FakeClassTarget::append_or_send(std::size_t tile, const Append& append) {
  if (!append()) {
    send(writer_.finish(tile, header_.sequence));
    static_cast<void>(append());
  }
}

template <typename Write>
void FakeClassTarget::send_end(stream::MessageType type, const Write& write) {
  std::array<std::byte, protection::kMaxMessageBytes> message{};
  const auto content = std::span<std::byte>(message).subspan(protection::kProtectionBytes);
  header_.type = type;
  const std::size_t head = stream::write_header(header_, content);
  const std::size_t body = write(content.subspan(head));
  send(std::span(message).first(protection::kProtectionBytes + head + body));
}

void FakeClassTarget::send_indexes() {
  writer_.begin_grid(header_, stream::geometry_of_level(0));
  hash_ = stream::GridHash();
  for (std::size_t tile = 0; tile < geometry::kTileCount; tile += 50) {
    const auto cells = index_tile(tile, frame_);
    hash_.add(tile, cells);
    append_or_send(tile, [&] { return writer_.append(tile, stream::Encoding::kRaw, cells); });
  }
  send(writer_.finish(geometry::kTileCount, header_.sequence));
}

void FakeClassTarget::send_classes() {
  const auto tiles = world_.tiles_in(frame_);
  sent_ = static_cast<std::uint32_t>(tiles.size());
  writer_.begin_classes(header_, window_, geometry::kCellMm, world_.extent);
  for (const auto& tile : tiles) {
    const std::size_t number = tile.first;
    const FakeClassWorld::Cells& cells = tile.second;
    std::array<std::byte, tile_coding::kTileBytes> payload{};
    const auto encoded =
        encoder_->encode(cells, frame_, references_->usable(number, frame_), payload);
    if (stream::stands_by_itself(encoded.encoding)) {
      references_->keep(number, cells, frame_, encoded.bytes);
    } else {
      references_->note_changes(number, encoded.bytes);
    }
    append_or_send(number, [&] {
      return writer_.append(number, encoded.encoding, FakeClassWorld::age_of(number, frame_),
                            std::span(payload).first(encoded.bytes));
    });
  }
  send(writer_.finish(world_.extent.tile_count(), header_.sequence));
}

void FakeClassTarget::send_class_end() {
  stream::ClassEnd end{.window = window_,
                       .tiles_sent = sent_,
                       .classes_crc = world_.name_of(frame_),
                       .packets_placed = 20 + frame_,
                       .packets_not_placed = 1,
                       .slice_count = 5};
  end.causes[static_cast<std::size_t>(pose::Cause::kNone)].slices = 5 * (frame_ + 1);
  end.causes[static_cast<std::size_t>(pose::Cause::kLate)].slices = 3;
  end.causes[static_cast<std::size_t>(pose::Cause::kJump)].began.times = 2;
  end.pose_fates[static_cast<std::size_t>(pose::Fate::kUsed)] = 40 * (frame_ + 1);
  send_end(stream::MessageType::kClassEnd,
           [&](std::span<std::byte> body) { return stream::write_class_end(end, body); });
}

// Every third moves; ids have gaps.
stream::ObjectList FakeClassTarget::objects_in(std::uint32_t frame, std::uint16_t count) {
  stream::ObjectList list{.time_us = 1'000'000 + 40'000 * std::uint64_t{frame},
                          .tracks_refused = 1,
                          .hits_left = static_cast<std::uint16_t>(frame),
                          .count = count};
  for (std::uint16_t i = 0; i < count; ++i) {
    stream::ObjectRecord& object = list.records.at(i);
    object.id = frame + 2U * i + 1;
    object.age_frames = static_cast<std::uint16_t>(frame + 4);
    object.x_mm = 1000 * i - static_cast<std::int32_t>(frame);
    object.length_cm = static_cast<std::uint16_t>(50 + i);
    if (i % 3 == 0) {
      object.state = stream::ObjectState::kMoves;
      object.flags = stream::kObjectHasHeading;
      object.vx_cm_s = static_cast<std::int16_t>(-100 - i);
      object.sigma_v_along_cm_s = 30;
      object.sigma_v_across_cm_s = 20;
    }
  }
  return list;
}

void FakeClassTarget::send_objects() {
  const stream::ObjectList list = objects_in(frame_, *objects_);
  for (std::size_t part = 0; part < stream::parts_of(list); ++part) {
    send_end(stream::MessageType::kObjects,
             [&](std::span<std::byte> body) { return stream::write_objects(list, part, body); });
  }
}

void FakeClassTarget::send_frame_end() {
  const stream::FrameEnd end{
      .tiles_sent = has_indexes_ ? static_cast<std::uint32_t>(kKnownIndexTiles) : 0U,
      .grid_crc = has_indexes_ ? hash_.value() : 0U};
  send_end(stream::MessageType::kFrameEnd, [&](std::span<std::byte> body) {
    return stream::write_frame_end(end, header_.sensor_count, body);
  });
}

}  // namespace iog::tools
