// Sends the grid over a serial link that is far too slow for the full grid (docs/spec.md 3.8).
// Tiles are always encoded from the newest frame.
//
//     frame -> coarse levels, some tiles of cells -> message -> protection -> COBS -> port
//
// Three flows share the link: the coarsest grid (*rough*, 3.2 m cells), the medium grid (*fine*,
// 0.8 m cells), and the full-resolution cells. Each flow sends the tiles of its grid in rounds,
// with at most one round per frame. If a round is not complete when the frame ends, the flow
// resumes it in the next frame. Each message covers a range of tiles and contains the cells of
// every known tile in this range. All other tiles in the range are unknown. A receiver's tiles are
// therefore at most one round old. If no sensor contributed to a frame, the frame has no known
// cells. In this case, the sender transmits only an empty message of the coarsest grid as a
// heartbeat.
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

// The object must be static because it takes up 64 KB.
class GridSender {
 public:
  // The maximum number of tiles that one call of pump() encodes.
  static constexpr std::size_t kTilesPerPump = 2;

  // The constructor is not constexpr. The object is therefore initialised at start-up and takes up
  // no space in the image.
  GridSender();

  // Sets the cell size and origin of the messages. Call describe() before the first frame. Each
  // grid on this link is as large as the default grid. Cells outside the car's grid are unknown. If
  // a side of the car's grid is longer, nothing is sent.
  void describe(const geometry::Grid& grid) {
    grid_ = grid;
    rows_ = geometry::TileRows(grid);
    fits_ = grid.columns <= geometry::kCellsPerSide && grid.rows <= geometry::kCellsPerSide;
  }

  // For each complete frame, call begin_frame(), then take_tile() for each known tile in ascending
  // order, and then end_frame(). Together, these calls read each cell once and copy at most
  // DetailWindow::kTiles tiles. Do not call pump() between these calls.
  void begin_frame(const stream::Header& header);
  void take_tile(std::size_t tile, tile_coding::TileCells cells);
  void end_frame();

  // Call pump() once per loop iteration. Each call encodes at most kTilesPerPump tiles, protects
  // and frames at most one message, and passes at most as many bytes to the port as the link
  // transmits in 40 ms. `now_us` must not decrease.
  template <hal::SerialPort Port>
  void pump(std::uint64_t now_us, Port& port) {
    bucket_.refill(now_us, port.bytes_per_second());
    write(port);
    if (frame_left_.empty() && compose()) {
      write(port);
    }
    port.pump();
  }

  // Returns the number of messages composed since start-up.
  [[nodiscard]] std::uint32_t messages() const { return sequence_; }

 private:
  enum Flow : std::size_t { kRough, kFine, kCells };
  static constexpr std::size_t kFlows = 3;
  // Each weight is in twelfths of the link's capacity. At 115200 baud, each coarse grid is sent
  // about four times per second. The remaining capacity is used for the full-resolution cells,
  // which always need more than the link can transmit.
  static constexpr std::array<std::uint32_t, kFlows> kWeights{1, 3, 8};

  // The tiles of this frame that a flow may still send.
  struct Round {
    std::size_t next = 0;  // number of the next tile
    std::size_t left = 0;  // number of remaining tiles from `next` on, modulo the grid
  };

  // Continues composing a message. Meanwhile, the link sends the previous message, which takes
  // about 40 ms. Returns true if the message is complete and stored in frame_left_.
  [[nodiscard]] bool compose();
  [[nodiscard]] bool begin_message();
  // Returns false if the message is complete.
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

  // The state of the newest frame.
  geometry::Grid grid_;
  geometry::TileRows rows_;
  bool fits_ = true;
  stream::Header header_;
  CoarseLevels coarse_;
  DetailWindow window_;

  std::array<Round, kFlows> rounds_{};
  FairQueue<kFlows> queue_{kWeights};

  // The message being composed: its flow, its next tile and its end.
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

  // The message that is being sent, and its unsent bytes.
  std::array<std::byte, framing::max_framed_bytes(protection::kMaxMessageBytes)> frame_{};
  std::span<const std::byte> frame_left_;
  TokenBucket bucket_;
};

}  // namespace iog::serial
