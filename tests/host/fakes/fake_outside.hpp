// An Outside (app/pipeline.hpp) that keeps every message and can refuse them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stream/message.hpp"
#include "stream/tile.hpp"

namespace iog::tests {

struct ReceivedFrame {
  stream::Header header;  // of its last message
  stream::FrameEnd end;
  std::vector<index::OccupancyIndex> cells;
};

class FakeOutside {
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
  void fill_vitals(stream::Header& header, stream::FrameEnd& end) const {
    header.packets_dropped += link_drops;
    end.stack_used_bytes = 4711;
  }

  std::uint32_t link_drops = 0;

  void allow_messages(int count) { room_left_ = count; }
  [[nodiscard]] int unreadable() const { return unreadable_; }
  [[nodiscard]] const std::vector<std::uint32_t>& sequences() const { return sequences_; }

  std::vector<ReceivedFrame> frames;

 private:
  void receive(std::span<const std::byte> message) {
    if (cells_.empty()) {
      cells_.resize(grid::kCellCount);
    }
    stream::Header header;
    std::span<const std::byte> body;
    if (stream::read_header(message, header, body) != stream::ReadStatus::kOk) {
      ++unreadable_;
      return;
    }
    sequences_.push_back(header.sequence);
    if (header.type == stream::MessageType::kTile) {
      take_tile(body);
      return;
    }
    ReceivedFrame frame{.header = header, .end = {}, .cells = std::move(cells_)};
    unreadable_ +=
        stream::read_frame_end(body, header.sensor_count, frame.end) != stream::ReadStatus::kOk ? 1
                                                                                                : 0;
    frames.push_back(std::move(frame));
    cells_ = {};
  }

  void take_tile(std::span<const std::byte> body) {
    stream::TileHeader tile;
    std::span<const std::byte> payload;
    if (stream::read_tile(body, tile, payload) != stream::ReadStatus::kOk) {
      ++unreadable_;
      return;
    }
    for (std::size_t i = 0; i < payload.size(); ++i) {
      const std::size_t x = tile.tile_x * stream::kTileSide + i % stream::kTileSide;
      const std::size_t y = tile.tile_y * stream::kTileSide + i / stream::kTileSide;
      cells_[y * grid::kStride + x] = static_cast<index::OccupancyIndex>(payload[i]);
    }
  }

  int room_left_ = 1 << 30;
  int unreadable_ = 0;
  std::uint32_t ticks_ = 0;
  std::vector<std::uint32_t> sequences_;
  std::vector<index::OccupancyIndex> cells_;
};

}  // namespace iog::tests
