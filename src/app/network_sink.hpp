// The network as a sink: a closed frame becomes messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "app/frame_messages.hpp"
#include "app/message_sender.hpp"
#include "app/platform.hpp"
#include "app/tile_sender.hpp"
#include "geometry/grid.hpp"
#include "stream/grid_hash.hpp"
#include "stream/message.hpp"

namespace iog::app {

// Holds what was sent, and a batch, 1.4 MB: belongs into static memory.
template <Platform P>
class NetworkSink {
 public:
  // platform outlives the sink.
  NetworkSink(P& platform, Coding coding)
      : messages_(platform), tiles_(platform, messages_, coding) {}
  NetworkSink(const NetworkSink&) = delete;
  NetworkSink& operator=(const NetworkSink&) = delete;

  void begin_frame(const FrameReport& report) { begin_frame(report, 0); }

  // Counts what was sent, and names all of it.
  void take_tile(std::size_t tile, tile_coding::TileCells cells) {
    hash_.add(tile % geometry::kTilesPerSide, tile / geometry::kTilesPerSide, cells);
    tiles_.add(tile, cells);
  }

  void end_frame() {
    end_tiles();
    send_frame_end();
  }

 protected:
  // flags: of the stream's header, beside those of the report.
  void begin_frame(const FrameReport& report, std::uint8_t flags) {
    header_ = header_of(report);
    header_.flags = static_cast<std::uint8_t>(header_.flags | flags);
    set_frame_end(report, end_);
    hash_ = {};
    tiles_.begin(header_);
  }

  void end_tiles() {
    const auto counts = tiles_.finish();
    end_.tiles_sent = counts.sent;
    end_.tiles_lost = counts.lost;
    end_.grid_crc = hash_.value();
  }

  void send_frame_end() {
    messages_.send(header_, stream::MessageType::kFrameEnd, [this](std::span<std::byte> body) {
      return stream::write_frame_end(end_, header_.sensor_count, body);
    });
  }

  [[nodiscard]] const stream::Header& header() const { return header_; }
  [[nodiscard]] MessageSender<P>& messages() { return messages_; }

 private:
  // The frame at hand.
  stream::Header header_;
  stream::FrameEnd end_;
  stream::GridHash hash_;

  MessageSender<P> messages_;
  TileSender<P> tiles_;
};

}  // namespace iog::app
