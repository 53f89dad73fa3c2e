// Sends the grid over a serial link that is far too slow for it (docs/spec.md 3.8). What goes next
// is always of the newest frame.
//
//     frame -> coarse levels, some tiles of cells -> message -> protection -> COBS -> port
//
// Three flows share the link: the rough grid of 3.2 m, the fine one of 0.8 m, and the cells
// themselves. A flow goes round the tiles of its grid, at most once in a frame, and continues in
// the next frame where it stopped. A message states the cells of every tile that it speaks of, or
// that all of them are unknown; so nothing that a receiver has is older than one round. A frame in
// which no sensor took part says nothing of any cell. Of such a frame only an empty rough grid is
// sent, as a sign of life.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "framing/cobs.hpp"
#include "hal/serial_port.hpp"
#include "protection/protected_message.hpp"
#include "serial/coarse_levels.hpp"
#include "serial/detail_window.hpp"
#include "serial/fair_queue.hpp"
#include "serial/token_bucket.hpp"
#include "stream/channel.hpp"
#include "stream/tiles.hpp"
#include "tile_coding/encode.hpp"

namespace iog::serial {

// Holds 64 KB: belongs into static memory.
class GridSender {
 public:
  // At most so many tiles are encoded in one pump().
  static constexpr std::size_t kTilesPerPump = 2;

  // Not constexpr: in static memory it is set up at start-up, not carried by the image.
  GridSender();

  // Takes a closed frame: first its header, then its known tiles in rising order, then its end.
  // This costs a look at each cell and at most DetailWindow::kTiles copies of a tile. No pump() in
  // between.
  void begin_frame(const stream::Header& header);
  void take_tile(std::size_t tile, tile_coding::TileCells cells);
  void end_frame();

  // Once per pass of the loop. One call encodes at most kTilesPerPump tiles, protects and frames at
  // most one message, and hands over at most 40 ms of the link. now_us must not go back.
  template <hal::SerialPort Port>
  void pump(std::uint64_t now_us, Port& port) {
    bucket_.refill(now_us, port.bytes_per_second());
    write(port);
    if (frame_left_.empty() && compose()) {
      write(port);
    }
    port.pump();
  }

  // Messages made since start.
  [[nodiscard]] std::uint32_t messages() const { return sequence_; }

 private:
  enum Flow : std::size_t { kRough, kFine, kCells };
  static constexpr std::size_t kFlows = 3;
  // Twelfths of the link. At 115200 baud each coarse grid is then sent whole about four times a
  // second. The rest is for the cells, of which there are always more than the link can carry.
  static constexpr std::array<std::uint32_t, kFlows> kWeights{1, 3, 8};

  // What of a flow's grid is still to be sent of this frame.
  struct Round {
    std::size_t next = 0;  // tile
    std::size_t left = 0;  // tiles from there on, around the end of the grid
  };

  // Goes on with composing a message, while the link is still busy with the one before for some 40
  // ms. True when the message is complete and in frame_left_.
  [[nodiscard]] bool compose();
  [[nodiscard]] bool begin_message();
  // False when the message is finished.
  [[nodiscard]] bool append_tile();
  void finish_message(std::size_t end_tile);
  [[nodiscard]] std::size_t find_known(std::size_t tile) const;
  [[nodiscard]] tile_coding::TileCells cells_of(std::size_t tile);

  template <hal::SerialPort Port>
  void write(Port& port) {
    const std::size_t bytes = std::min({frame_left_.size(), bucket_.tokens(), port.free_bytes()});
    port.write(frame_left_.first(bytes));
    bucket_.spend(bytes);
    frame_left_ = frame_left_.subspan(bytes);
  }

  // The newest frame.
  stream::Header header_;
  CoarseLevels coarse_;
  DetailWindow window_;

  std::array<Round, kFlows> rounds_{};
  FairQueue<kFlows> queue_{kWeights};

  // The message that is being composed: of which flow, its next tile, and where it must end.
  bool is_composing_ = false;
  std::size_t flow_ = kRough;
  std::size_t tile_ = 0;
  std::size_t end_tile_ = 0;
  stream::TilesWriter writer_;
  tile_coding::Encoder encoder_;
  alignas(8) std::array<std::byte, tile_coding::kTileBytes> rough_{};
  alignas(8) std::array<std::byte, tile_coding::kTileBytes> payload_{};

  std::uint32_t sequence_ = 0;
  protection::Sender sender_{stream::kSerialChannel};

  // The message that is being sent, and what of it is left.
  std::array<std::byte, framing::max_framed_bytes(protection::kMaxMessageBytes)> frame_{};
  std::span<const std::byte> frame_left_;
  TokenBucket bucket_;
};

}  // namespace iog::serial
