// The network sink converts a closed frame to messages.
#pragma once

#include <cstddef>
#include <span>

#include "app/message_sender.hpp"
#include "app/platform.hpp"
#include "app/tile_sender.hpp"
#include "stream/grid_hash.hpp"
#include "stream/message.hpp"

namespace iog::app {

// A NetworkSink contains 2.4 MB of sent and encoded tiles, so it must be in static memory.
template <Platform P>
class NetworkSink {
 public:
  // `platform` must outlive this object.
  NetworkSink(P& platform, Coding coding, const geometry::Grid& grid = {})
      : messages_(platform), tiles_(platform, messages_, coding, grid) {}
  NetworkSink(const NetworkSink&) = delete;
  NetworkSink& operator=(const NetworkSink&) = delete;

  // Returns the end message of the current frame. Before the frame begins, fill in all fields of
  // this message except the tile counts.
  [[nodiscard]] stream::FrameEnd& end() { return end_; }

  void begin_frame(const stream::Header& header) {
    header_ = header;
    tiles_.begin(header_);
  }

  // Returns a place for the cells of the next tile (see TileSender::place()).
  [[nodiscard]] tile_coding::MutableTileCells tile_place() { return tiles_.place(); }

  // Sends and counts a tile, and adds the tile to the grid's CRC.
  void take_tile(std::size_t tile, tile_coding::TileCells cells) {
    tiles_.add(tile, cells, CellsStay::kForTheCall);
  }

  void end_frame() {
    end_tiles(tiles_.finish());
    send_frame_end();
  }

 protected:
  // Encodes all waiting tiles (see TileSender::encode()).
  template <typename DoBeside>
  void encode_tiles(DoBeside do_beside) {
    tiles_.encode(do_beside);
  }
  void encode_rest() { tiles_.encode_rest(); }

  // Adds a tile whose cells do not change until the frame ends.
  void take_staying(std::size_t tile, tile_coding::TileCells cells) {
    tiles_.add(tile, cells, CellsStay::kToTheFinish);
  }

  // Call this function only after all waiting tiles have been encoded.
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

  // The current frame.
  stream::Header header_;
  stream::FrameEnd end_;

  MessageSender<P> messages_;
  TileSender<P, stream::GridHash> tiles_;
};

}  // namespace iog::app
