// A Platform (app/platform.hpp) that keeps every message and can refuse them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/platform.hpp"
#include "protection/protected_message.hpp"
#include "stream/channel.hpp"
#include "stream/class_end.hpp"
#include "stream/message.hpp"
#include "stream/objects.hpp"
#include "stream/references.hpp"
#include "stream/tiles.hpp"
#include "tools/frames/tile_decoding.hpp"
#include "work/round.hpp"

namespace iog::tests {

struct ReceivedClassTile {
  std::uint8_t age_frames = 0;
  std::array<std::byte, tile_coding::kTileBytes> cells{};
};

struct ReceivedFrame {
  stream::Header header;  // of its last message
  stream::FrameEnd end;
  std::vector<index::OccupancyIndex> cells;
  std::optional<stream::ClassEnd> class_end{};
  std::map<std::size_t, ReceivedClassTile> classes{};
  std::vector<stream::ObjectPart> objects{};
  std::vector<stream::ClassWindow> windows{};  // one a message of class tiles
  std::size_t class_tiles_spoken_of = 0;
  std::vector<int> message_types{};  // 10 + storage for tiles, else the type
};

class FakePlatform {
 public:
  static constexpr std::uint32_t kRunNumber = 0x00C0FFEE;

  [[nodiscard]] bool send_message(std::span<const std::byte> message) {
    if (room_left_ == 0) {
      return false;
    }
    if (refused_left_ > 0) {
      --refused_left_;
      return false;
    }
    --room_left_;
    kept_messages += is_cache_kept ? 1 : 0;
    receive(message);
    return true;
  }

  std::uint32_t ticks() { return ++ticks_; }
  [[nodiscard]] std::uint32_t ticks_hz() const { return 1000; }
  [[nodiscard]] static std::uint32_t run_number() { return kRunNumber; }
  static constexpr std::size_t kMostCores = 1;
  [[nodiscard]] static std::size_t cores() { return kMostCores; }
  static void share(std::size_t items, work::Work work, work::Beside beside = {}) {
    work::do_alone(items, work, beside);
  }
  [[nodiscard]] app::Vitals vitals(const app::FrameTimes& /*times*/) const {
    return {.stack_used_bytes = 4711,
            .link_drops = link_drops,
            .temperature_dc = 612,
            .link_counter_count = 2,
            .link_counters = {11, 12}};
  }

  void keep_cache(bool keep) { is_cache_kept = keep; }

  std::uint32_t link_drops = 0;
  bool is_cache_kept = false;
  int kept_messages = 0;  // while the cache was kept

  void allow_messages(int count) { room_left_ = count; }
  // Of the messages that come now.
  void refuse_messages(int count) { refused_left_ = count; }
  [[nodiscard]] int unreadable() const { return unreadable_; }
  [[nodiscard]] int tile_messages() const { return tile_messages_; }
  [[nodiscard]] const std::vector<std::uint32_t>& sequences() const { return sequences_; }

  std::vector<ReceivedFrame> frames;

 private:
  void receive(std::span<const std::byte> message) {
    if (cells_.empty()) {
      cells_.resize(geometry::kCellCount);
    }
    const protection::Received received = receiver_.receive(message);
    stream::Header header;
    std::span<const std::byte> body;
    if (stream::read_header(received.content, header, body) != stream::ReadStatus::kOk) {
      ++unreadable_;
      return;
    }
    sequences_.push_back(header.sequence);
    if (header.type == stream::MessageType::kTiles) {
      take_tiles(header, body);
      return;
    }
    open_.message_types.push_back(static_cast<int>(header.type));
    if (header.type == stream::MessageType::kClassEnd) {
      expect_ok(stream::read_class_end(body, open_.class_end.emplace()));
      return;
    }
    if (header.type == stream::MessageType::kObjects) {
      expect_ok(stream::read_objects(body, open_.objects.emplace_back()));
      return;
    }
    open_.header = header;
    expect_ok(stream::read_frame_end(body, header.sensor_count, open_.end));
    open_.cells = std::move(cells_);
    frames.push_back(std::exchange(open_, {}));
    cells_ = {};
  }

  void expect_ok(stream::ReadStatus status) {
    unreadable_ += status != stream::ReadStatus::kOk ? 1 : 0;
  }

  void take_tiles(const stream::Header& header, std::span<const std::byte> body) {
    stream::TilesHeader tiles;
    stream::TileRecords records;
    if (stream::read_tiles(body, tiles, records) != stream::ReadStatus::kOk) {
      ++unreadable_;
      return;
    }
    ++tile_messages_;
    open_.message_types.push_back(10 + static_cast<int>(tiles.geometry.storage));
    if (tiles.window) {
      open_.windows.push_back(*tiles.window);
      open_.class_tiles_spoken_of += std::size_t{tiles.end_tile} - tiles.first_tile;
    }
    stream::References& references = tiles.window ? *class_references_ : *references_;
    for (stream::TileRecord record; records.next(record);) {
      std::array<std::byte, tile_coding::kTileBytes> cells{};
      if (tile_coding::decode(record.encoding, record.payload, header.frame_number,
                              references.find(record.tile),
                              cells) != tile_coding::DecodeStatus::kOk) {
        ++unreadable_;
        continue;
      }
      if (stream::stands_by_itself(record.encoding)) {
        references.keep(record.tile, cells, header.frame_number, record.payload.size());
      }
      if (tiles.window) {
        open_.classes[record.tile] = {record.age_frames, cells};
      } else {
        paste(record.tile, cells);
      }
    }
  }

  void paste(std::size_t tile, std::span<const std::byte, tile_coding::kTileBytes> cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::size_t x =
          tile % geometry::kTilesPerSide * geometry::kTileSide + i % geometry::kTileSide;
      const std::size_t y =
          tile / geometry::kTilesPerSide * geometry::kTileSide + i / geometry::kTileSide;
      cells_[y * geometry::kCellsPerSide + x] = static_cast<index::OccupancyIndex>(cells[i]);
    }
  }

  int room_left_ = 1 << 30;
  int refused_left_ = 0;
  int unreadable_ = 0;
  int tile_messages_ = 0;
  protection::Receiver receiver_{stream::kNetworkChannel};
  std::unique_ptr<stream::References> references_ = std::make_unique<stream::References>();
  std::unique_ptr<stream::References> class_references_ = std::make_unique<stream::References>();
  std::uint32_t ticks_ = 0;
  ReceivedFrame open_{};
  std::vector<std::uint32_t> sequences_;
  std::vector<index::OccupancyIndex> cells_;
};

}  // namespace iog::tests
