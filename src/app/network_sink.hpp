// The network as a sink: a closed frame becomes messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/frame_messages.hpp"
#include "app/platform.hpp"
#include "geometry/grid.hpp"
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

// Holds what was sent, 1 MB: belongs into static memory.
template <Platform P>
class NetworkSink {
 public:
  // platform outlives the sink.
  NetworkSink(P& platform, Coding coding) : platform_(&platform), coding_{coding} {}

  void begin_frame(const FrameReport& report) {
    header_ = header_of(report);
    end_ = frame_end_of(report);
    hash_ = {};
    tiles_.begin_grid(header_, stream::geometry_of_level(0));
  }

  // Counts what was sent, and names all of it.
  void take_tile(std::size_t tile, tile_coding::TileCells cells) {
    hash_.add(tile % geometry::kTilesPerSide, tile / geometry::kTilesPerSide, cells);
    append(tile, cells);
  }

  // If the last message cannot go, the next frame's number shows it.
  void end_frame() {
    send_tiles(geometry::kTileCount);
    end_.grid_crc = hash_.value();
    std::array<std::byte, protection::kMaxMessageBytes> message;
    const auto content = std::span<std::byte>(message).subspan(protection::kProtectionBytes);
    header_.type = stream::MessageType::kFrameEnd;
    header_.sequence = sequence_;
    const std::size_t head = stream::write_header(header_, content);
    const std::size_t body =
        stream::write_frame_end(end_, header_.sensor_count, content.subspan(head));
    require(body > 0);
    static_cast<void>(
        send_protected(std::span(message).first(protection::kProtectionBytes + head + body)));
  }

 private:
  void append(std::size_t tile, tile_coding::TileCells cells) {
    if (coding_ == Coding::kRaw) {
      append_or_send(tile, stream::Encoding::kRaw, cells);
      return;
    }
    const auto encoded =
        encoder_.encode(cells, references_.usable(tile, header_.frame_number), payload_);
    if (stream::stands_by_itself(encoded.encoding)) {
      references_.keep(tile, cells, header_.frame_number, encoded.bytes);
    }
    append_or_send(tile, encoded.encoding, std::span(payload_).first(encoded.bytes));
  }

  void append_or_send(std::size_t tile, stream::Encoding encoding,
                      std::span<const std::byte> payload) {
    if (tiles_.append(tile, encoding, payload)) {
      return;
    }
    send_tiles(tile);
    require(tiles_.append(tile, encoding, payload));
  }

  void send_tiles(std::size_t end_tile) {
    const std::uint32_t count = tiles_.tile_count();
    const bool is_sent = send_protected(tiles_.finish(end_tile, sequence_));
    (is_sent ? end_.tiles_sent : end_.tiles_lost) += count;
  }

  // Every message is numbered, so that a receiver misses one that could not be sent.
  [[nodiscard]] bool send_protected(std::span<std::byte> message) {
    sender_.protect(message);
    ++sequence_;
    return platform_->send_message(message);
  }

  P* platform_;
  Coding coding_;

  // The frame at hand.
  stream::Header header_;
  stream::FrameEnd end_;
  stream::GridHash hash_;

  std::uint32_t sequence_ = 0;
  protection::Sender sender_{stream::kNetworkChannel};
  stream::TilesWriter tiles_;
  tile_coding::Encoder encoder_;
  alignas(8) std::array<std::byte, tile_coding::kTileBytes> payload_{};
  stream::References references_;
};

}  // namespace iog::app
