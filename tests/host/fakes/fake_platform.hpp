// A Platform (app/platform.hpp) that keeps every message and can refuse them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "app/frame_report.hpp"
#include "protection/protected_message.hpp"
#include "stream/channel.hpp"
#include "stream/message.hpp"
#include "stream/references.hpp"
#include "stream/tiles.hpp"
#include "tile_coding/decode.hpp"

namespace iog::tests {

struct ReceivedFrame {
  stream::Header header;  // of its last message
  stream::FrameEnd end;
  std::vector<index::OccupancyIndex> cells;
};

class FakePlatform {
 public:
  [[nodiscard]] bool send_message(std::span<const std::byte> message) {
    if (room_left_ == 0) {
      return false;
    }
    --room_left_;
    receive(message);
    return true;
  }

  std::uint32_t ticks() { return ++ticks_; }
  [[nodiscard]] std::uint32_t ticks_hz() const { return 1000; }
  [[nodiscard]] app::Vitals vitals() const {
    return {.stack_used_bytes = 4711, .link_drops = link_drops};
  }

  std::uint32_t link_drops = 0;

  void allow_messages(int count) { room_left_ = count; }
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
    ReceivedFrame frame{.header = header, .end = {}, .cells = std::move(cells_)};
    unreadable_ +=
        stream::read_frame_end(body, header.sensor_count, frame.end) != stream::ReadStatus::kOk ? 1
                                                                                                : 0;
    frames.push_back(std::move(frame));
    cells_ = {};
  }

  void take_tiles(const stream::Header& header, std::span<const std::byte> body) {
    stream::TilesHeader tiles;
    stream::TileRecords records;
    if (stream::read_tiles(body, tiles, records) != stream::ReadStatus::kOk) {
      ++unreadable_;
      return;
    }
    ++tile_messages_;
    for (stream::TileRecord record; records.next(record);) {
      std::array<std::byte, tile_coding::kTileBytes> cells{};
      if (tile_coding::decode(record.encoding, record.payload, references_->find(record.tile),
                              cells) != tile_coding::DecodeStatus::kOk) {
        ++unreadable_;
        continue;
      }
      if (stream::stands_by_itself(record.encoding)) {
        references_->keep(record.tile, cells, header.frame_number, record.payload.size());
      }
      paste(record.tile, cells);
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
  int unreadable_ = 0;
  int tile_messages_ = 0;
  protection::Receiver receiver_{stream::kNetworkChannel};
  std::unique_ptr<stream::References> references_ = std::make_unique<stream::References>();
  std::uint32_t ticks_ = 0;
  std::vector<std::uint32_t> sequences_;
  std::vector<index::OccupancyIndex> cells_;
};

}  // namespace iog::tests
