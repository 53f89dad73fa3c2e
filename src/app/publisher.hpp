// From a closed frame to its messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "grid/frame_fusion.hpp"
#include "protection/protected_message.hpp"
#include "require/require.hpp"
#include "stream/channel.hpp"
#include "stream/grid_hash.hpp"
#include "stream/message.hpp"
#include "stream/references.hpp"
#include "stream/tiles.hpp"
#include "tile_coding/encode.hpp"

namespace iog::app {

// How tiles are sent. The shortest encoding takes several times the instructions of a raw tile and
// makes a tenth of the bytes.
enum class Coding : std::uint8_t { kShortest, kRaw };

// send(message): sends a copy, at most protection::kMaxMessageBytes; false when none can go out.
// Holds what was sent, 1 MB: belongs into static memory.
class Publisher {
 public:
  explicit Publisher(Coding coding) : coding_{coding} {}

  // Sends every tile in which something is known, and sets it back to unknown. Counts what was sent
  // and names it in `end`. show(tile, cells): looks at each of them.
  template <typename Send, typename Show>
  void publish_tiles(grid::FrameFusion& fusion, const stream::Header& header, stream::FrameEnd& end,
                     Send&& send, Show&& show) {
    stream::GridHash hash;
    tiles_.begin_grid(header, stream::geometry_of_level(0));
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      if (!fusion.is_touched(tile)) {
        continue;
      }
      const bool is_known = fusion.copy_tile(tile, cells_);
      fusion.clear_tile(tile);
      if (is_known) {
        hash.add(tile % geometry::kTilesPerSide, tile / geometry::kTilesPerSide, cell_bytes());
        show(tile, cell_bytes());
        append(tile, header.frame_number, end, send);
      }
    }
    send_tiles(geometry::kTileCount, end, send);
    end.grid_crc = hash.value();
  }

  // If it cannot go, the next frame's number shows it.
  template <typename Send>
  void publish_end(stream::Header& header, const stream::FrameEnd& end, Send&& send) {
    std::array<std::byte, protection::kMaxMessageBytes> message;
    const auto content = std::span<std::byte>(message).subspan(protection::kProtectionBytes);
    header.type = stream::MessageType::kFrameEnd;
    header.sequence = sequence_;
    const std::size_t head = stream::write_header(header, content);
    const std::size_t body =
        stream::write_frame_end(end, header.sensor_count, content.subspan(head));
    require(body > 0);
    static_cast<void>(
        send_protected(std::span(message).first(protection::kProtectionBytes + head + body), send));
  }

 private:
  [[nodiscard]] std::span<const std::byte, tile_coding::kTileBytes> cell_bytes() const {
    return std::as_bytes(std::span(cells_));
  }

  // The tile is in cells_.
  template <typename Send>
  void append(std::size_t tile, std::uint32_t frame_number, stream::FrameEnd& end, Send&& send) {
    if (coding_ == Coding::kRaw) {
      append_or_send(tile, stream::Encoding::kRaw, cell_bytes(), end, send);
      return;
    }
    const auto encoded =
        encoder_.encode(cell_bytes(), references_.usable(tile, frame_number), payload_);
    if (stream::stands_by_itself(encoded.encoding)) {
      references_.keep(tile, cell_bytes(), frame_number, encoded.bytes);
    }
    append_or_send(tile, encoded.encoding, std::span(payload_).first(encoded.bytes), end, send);
  }

  template <typename Send>
  void append_or_send(std::size_t tile, stream::Encoding encoding,
                      std::span<const std::byte> payload, stream::FrameEnd& end, Send&& send) {
    if (tiles_.append(tile, encoding, payload)) {
      return;
    }
    send_tiles(tile, end, send);
    require(tiles_.append(tile, encoding, payload));
  }

  template <typename Send>
  void send_tiles(std::size_t end_tile, stream::FrameEnd& end, Send&& send) {
    const std::uint32_t count = tiles_.tile_count();
    const bool is_sent = send_protected(tiles_.finish(end_tile, sequence_), send);
    (is_sent ? end.tiles_sent : end.tiles_lost) += count;
  }

  // Every message is numbered, so that a receiver misses one that could not be sent.
  template <typename Send>
  [[nodiscard]] bool send_protected(std::span<std::byte> message, Send&& send) {
    sender_.protect(message);
    ++sequence_;
    return send(std::span<const std::byte>(message));
  }

  Coding coding_;
  std::uint32_t sequence_ = 0;
  protection::Sender sender_{stream::kNetworkChannel};
  stream::TilesWriter tiles_;
  tile_coding::Encoder encoder_;
  alignas(8) std::array<index::OccupancyIndex, tile_coding::kTileBytes> cells_{};
  alignas(8) std::array<std::byte, tile_coding::kTileBytes> payload_{};
  stream::References references_;
};

}  // namespace iog::app
