// The network as a sink: a closed frame becomes messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

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

  // What the frame at hand says of itself when it ends: filled by who knows it before the frame is
  // begun, but for what becomes of the tiles.
  [[nodiscard]] stream::FrameEnd& end() { return end_; }

  void begin_frame(const stream::Header& header) {
    header_ = header;
    tiles_.begin(header_);
  }

  // Counts what was sent, and takes it into the grid's CRC.
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
