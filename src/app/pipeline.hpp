// The pipeline: the walk of the data, from a datagram to the last message of its frame.
//
// Everything outside comes through one seam, so that the target and the PC run this very file.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/frame_engine.hpp"
#include "require/require.hpp"
#include "stream/tile.hpp"

namespace iog::app {

// send_message(bytes): sends a copy, at most kMaxMessageBytes; false when none can go out.
// ticks(), ticks_hz(): a stopwatch, as hal::Stopwatch.
// fill_vitals(header, end): link counters and stack depth of the machine; adds the datagrams that
//                   the link itself has dropped to the header's count.
template <typename T>
concept Outside = requires(T& outside, std::span<const std::byte> message, stream::Header& header,
                           stream::FrameEnd& end) {
  { outside.send_message(message) } -> std::same_as<bool>;
  { outside.ticks() } -> std::same_as<std::uint32_t>;
  { outside.ticks_hz() } -> std::same_as<std::uint32_t>;
  { outside.fill_vitals(header, end) } -> std::same_as<void>;
};

template <Outside Out>
class Pipeline {
 public:
  // vehicle and out outlive the pipeline. start_us: the time from which silence is counted.
  Pipeline(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4, Out& out,
           std::uint64_t start_us)
      : engine_(vehicle, replayer_ipv4, start_us), out_(&out) {}

  // One datagram. Closes the frame before it, after it, or not at all.
  void take(const SensorDatagram& datagram, std::uint64_t now_us) {
    if (fuse(datagram, now_us) == FrameEngine::Inspection::kNextFrame) {
      close_frame(now_us);
      static_cast<void>(fuse(datagram, now_us));
    }
    if (engine_.is_complete()) {
      close_frame(now_us);
    }
  }

  // Time has passed.
  void tick(std::uint64_t now_us) {
    if (engine_.is_overdue(now_us)) {
      close_frame(now_us);
    }
  }

  [[nodiscard]] std::uint64_t deadline_us() const { return engine_.deadline_us(); }

  // Between two frames; see grid::FrameFusion.
  void forget_lines() { engine_.fusion().forget_lines(); }

 private:
  FrameEngine::Inspection fuse(const SensorDatagram& datagram, std::uint64_t now_us) {
    const std::uint32_t start = out_->ticks();
    const FrameEngine::Inspection inspection = engine_.inspect(datagram);
    if (inspection == FrameEngine::Inspection::kThisFrame) {
      engine_.fuse(now_us);
    }
    ticks_.fuse += out_->ticks() - start;
    return inspection;
  }

  void close_frame(std::uint64_t now_us) {
    const std::uint32_t start = out_->ticks();
    engine_.finish();
    const std::uint32_t marked = out_->ticks();

    stream::Header header;
    stream::FrameEnd end;
    engine_.report(now_us, header, end);
    out_->fill_vitals(header, end);
    publish_tiles(header, end);
    end.ticks = {.fuse = ticks_.fuse, .mark = marked - start, .publish = ticks_.publish};
    end.stopwatch_hz = out_->ticks_hz();
    publish_end(header, end);

    engine_.start_next(now_us);
    ticks_ = {.fuse = 0, .mark = 0, .publish = out_->ticks() - marked};
  }

  // Sends every tile in which something is known, and sets it back to unknown.
  void publish_tiles(const stream::Header& header, stream::FrameEnd& end) {
    grid::FrameFusion& fusion = engine_.fusion();
    stream::TileMessage message(header);
    stream::GridHash hash;
    for (std::size_t tile = 0; tile < stream::kTileCount; ++tile) {
      if (!fusion.is_touched(tile)) {
        continue;
      }
      const bool is_known = fusion.copy_tile(tile, message.cells());
      fusion.clear_tile(tile);
      if (is_known) {
        const std::size_t x = tile % stream::kTilesPerSide;
        const std::size_t y = tile / stream::kTilesPerSide;
        hash.add(x, y, message.cell_bytes());
        message.set_tile(x, y);
        message.set_sequence(sequence_);
        ++(send(message.bytes()) ? end.tiles_sent : end.tiles_lost);
      }
    }
    end.grid_crc = hash.value();
  }

  // If it cannot go, the next frame's number shows it.
  void publish_end(stream::Header& header, const stream::FrameEnd& end) {
    std::array<std::byte, stream::kMaxMessageBytes> message;
    header.type = stream::MessageType::kFrameEnd;
    header.sequence = sequence_;
    const std::size_t head = stream::write_header(header, message);
    const std::size_t body =
        stream::write_frame_end(end, header.sensor_count, std::span(message).subspan(head));
    require(body > 0);
    static_cast<void>(send(std::span(message).first(head + body)));
  }

  // Only what has been sent is numbered.
  [[nodiscard]] bool send(std::span<const std::byte> message) {
    const bool is_sent = out_->send_message(message);
    sequence_ += is_sent ? 1U : 0U;
    return is_sent;
  }

  FrameEngine engine_;
  Out* out_;
  std::uint32_t sequence_ = 0;
  stream::StageTicks ticks_;
};

}  // namespace iog::app
