// Sends the grid over a line that is far too slow for it (docs/spec.md 3.8): what goes next is
// always of the newest frame.
//
//     frame -> coarse levels, some tiles of cells -> message -> protection -> COBS -> port
//
// Three parties share the line: the rough grid of 3.2 m, the fine one of 0.8 m, and the cells, each
// at most once a frame. Each goes round its tiles, from frame to frame where it stopped, and a
// message says of each tile that it speaks of what its cells are or that all are unknown: so
// nothing that a receiver has is older than a round. A frame in which no sensor took part says
// nothing of any cell; of it goes an empty rough grid alone, as a sign of life.
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
#include "serial/line_budget.hpp"
#include "serial/line_share.hpp"
#include "stream/channel.hpp"
#include "stream/tiles.hpp"
#include "tile_coding/encode.hpp"

namespace iog::serial {

// Holds 64 KB: belongs into static memory.
class GridSender {
 public:
  // At most so many tiles are encoded in one pump().
  static constexpr std::size_t kTilesPerPump = 2;

  // A frame, when it has closed: its header, its known tiles in rising order, and that it is over.
  // Costs a look at each cell and kTiles copies of a tile. No pump() in between.
  void begin_frame(const stream::Header& header);
  void take_tile(std::size_t tile, tile_coding::TileCells cells);
  void end_frame();

  // Once per pass of the loop. Besides the tiles it encodes, it protects and frames at most one
  // message and hands over 40 ms of the line at most. now_us must not go back.
  template <hal::SerialPort Port>
  void pump(std::uint64_t now_us, Port& port) {
    budget_.advance(now_us, port.bytes_per_second());
    write(port);
    if (frame_left_.empty() && compose()) {
      write(port);
    }
    port.pump();
  }

  // Messages made since start.
  [[nodiscard]] std::uint32_t messages() const { return sequence_; }

 private:
  enum Party : std::size_t { kRough, kFine, kCells };
  static constexpr std::size_t kParties = 3;
  // Twelfths of the line. At 115200 baud each coarse grid then comes whole about four times a
  // second, and the rest is for the cells, of which there is always more than the line can carry.
  static constexpr std::array<std::uint32_t, kParties> kWeights{1, 3, 8};

  // What of a party's grid is to be told of this frame.
  struct Round {
    std::size_t next = 0;  // tile
    std::size_t left = 0;  // tiles from there on, around the end of the grid
  };

  // Goes on with a message, while the line still has some 40 ms of the one before. True when it is
  // in frame_left_.
  [[nodiscard]] bool compose();
  [[nodiscard]] bool begin_message();
  // False when the message is finished.
  [[nodiscard]] bool append_tile();
  void finish_message(std::size_t end_tile);
  [[nodiscard]] std::size_t find_known(std::size_t tile) const;
  [[nodiscard]] tile_coding::TileCells cells_of(std::size_t tile);

  template <hal::SerialPort Port>
  void write(Port& port) {
    const std::size_t bytes = std::min({frame_left_.size(), budget_.bytes(), port.free_bytes()});
    port.write(frame_left_.first(bytes));
    budget_.spend(bytes);
    frame_left_ = frame_left_.subspan(bytes);
  }

  // The newest frame.
  stream::Header header_;
  CoarseLevels coarse_;
  DetailWindow window_;

  std::array<Round, kParties> rounds_{};
  LineShare<kParties> share_{kWeights};

  // The message that is being composed: whose, what it may still speak of, and where it is.
  bool is_composing_ = false;
  std::size_t party_ = kRough;
  std::size_t tile_ = 0;
  std::size_t end_tile_ = 0;
  stream::TilesWriter writer_;
  tile_coding::Encoder encoder_;
  alignas(8) std::array<std::byte, tile_coding::kTileBytes> rough_{};
  alignas(8) std::array<std::byte, tile_coding::kTileBytes> payload_{};

  std::uint32_t sequence_ = 0;
  protection::Sender sender_{stream::kSerialChannel};

  // The message on the line, and what of it is left.
  std::array<std::byte, framing::max_framed_bytes(protection::kMaxMessageBytes)> frame_{};
  std::span<const std::byte> frame_left_;
  LineBudget budget_;
};

}  // namespace iog::serial
