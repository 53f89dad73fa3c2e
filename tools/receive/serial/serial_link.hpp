// From the bytes of a serial link to the grid: COBS frames, protected messages, tiles. It knows no
// device and no clock, and takes any bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>

#include "framing/cobs.hpp"
#include "protection/protected_message.hpp"
#include "stream/channel.hpp"
#include "stream/tiles.hpp"
#include "tools/receive/serial/layered_grid.hpp"

namespace iog::tools {

struct SerialCounts {
  std::uint64_t bytes = 0;           // on the line
  std::uint64_t messages = 0;        // whole, ours and readable
  std::uint64_t tiles = 0;           // of cells, in which something is known
  std::uint64_t coarse_tiles = 0;    // the same of the coarse grids
  std::uint64_t damaged = 0;         // what ended between two zeros and is no whole message
  std::uint64_t lost = 0;            // numbers that never came
  std::uint64_t repeated = 0;        // dropped
  std::uint64_t not_ours = 0;        // another protocol, service or event
  std::uint64_t other_version = 0;   // of ours: another version of the interface
  std::uint64_t malformed = 0;       // lengths or numbers that contradict each other
  std::uint64_t not_understood = 0;  // a type or a grid that is new to us
  std::uint64_t unreadable_tiles = 0;
  std::uint64_t restarts = 0;  // of the target
};

class SerialLink {
 public:
  // A tile of cells, as it was told.
  using TileHandler = std::function<void(std::size_t tile, const ToldTile& told)>;

  // After each message of tiles.
  using MessageHandler = std::function<void()>;

  explicit SerialLink(TileHandler on_tile = {}, MessageHandler on_message = {})
      : on_tile_{std::move(on_tile)}, on_message_{std::move(on_message)} {}

  void take(std::span<const std::byte> bytes);

  [[nodiscard]] const LayeredGrid& grid() const { return grid_; }
  [[nodiscard]] SerialCounts counts() const;
  // The interface version of the last message of another one; nothing if none has come.
  [[nodiscard]] std::optional<std::uint8_t> version_sent() const { return version_sent_; }

 private:
  void take_message(std::span<const std::byte> message);
  void take_content(std::span<const std::byte> content);
  [[nodiscard]] bool follow(const stream::Header& header);
  void take_tiles(const stream::Header& header, std::span<const std::byte> body);

  TileHandler on_tile_;
  MessageHandler on_message_;
  SerialCounts counts_;
  std::array<std::byte, protection::kMaxMessageBytes> buffer_{};
  framing::CobsDecoder decoder_{buffer_};
  protection::Receiver receiver_{stream::kSerialChannel};
  std::optional<std::uint8_t> version_sent_;
  std::optional<std::uint32_t> run_number_;
  std::uint32_t expected_ = 0;  // sequence number
  LayeredGrid grid_;
};

}  // namespace iog::tools
