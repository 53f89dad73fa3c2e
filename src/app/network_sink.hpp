// The network as a sink: a closed frame becomes messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "app/frame_messages.hpp"
#include "app/message_sender.hpp"
#include "app/platform.hpp"
#include "app/tile_sender.hpp"
#include "stream/grid_hash.hpp"
#include "stream/message.hpp"

namespace iog::app {

// Holds what was sent, and what was found, 2.4 MB: belongs into static memory.
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
    tiles_.add(tile, cells, CellsStay::kForTheCall);
  }

  void end_frame() {
    end_tiles(tiles_.finish());
    send_frame_end();
  }

 protected:
  // Encodes the tiles that wait; see TileSender::encode().
  template <typename DoBeside>
  void encode_tiles(DoBeside do_beside) {
    tiles_.encode(do_beside);
  }
  void encode_rest() { tiles_.encode_rest(); }

  // The same of cells that stay as they are to the frame's end.
  void take_staying(std::size_t tile, tile_coding::TileCells cells) {
    tiles_.add(tile, cells, CellsStay::kToTheFinish);
  }

  // flags: of the stream's header, beside those of the report.
  void begin_frame(const FrameReport& report, std::uint8_t flags) {
    header_ = header_of(report);
    header_.flags = static_cast<std::uint8_t>(header_.flags | flags);
    set_frame_end(report, end_);
    tiles_.begin(header_);
  }

  // All that wait are encoded.
  void end_encoded_tiles() { end_tiles(tiles_.finish_encoded()); }

  void send_frame_end() {
    messages_.send(header_, stream::MessageType::kFrameEnd, [this](std::span<std::byte> body) {
      return stream::write_frame_end(end_, header_.sensor_count, body);
    });
  }

  [[nodiscard]] const stream::Header& header() const { return header_; }
  [[nodiscard]] MessageSender<P>& messages() { return messages_; }

 private:
  void end_tiles(const typename TileSender<P, stream::GridHash>::Sent& sent) {
    end_.tiles_sent = sent.tiles;
    end_.tiles_lost = sent.tiles_lost;
    end_.grid_crc = sent.crc;
  }

  // The frame at hand.
  stream::Header header_;
  stream::FrameEnd end_;

  MessageSender<P> messages_;
  TileSender<P, stream::GridHash> tiles_;
};

}  // namespace iog::app
