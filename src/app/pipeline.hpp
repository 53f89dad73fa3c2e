// The pipeline: the walk of the data, from a datagram to the last message of its frame.
//
// Everything outside comes through one seam, so that the target and the PC run this very file.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/frame_engine.hpp"
#include "app/publisher.hpp"
#include "stream/message.hpp"

namespace iog::app {

// send_message(bytes): sends a copy, at most protection::kMaxMessageBytes; false when none can go
//                   out.
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

// An outside may look at each frame while it is published: begin_frame(header), take_tile(number,
// cells) for each tile in which something is known, in rising order, end_frame().
template <typename T>
concept FrameWatcher = requires(T& watcher, const stream::Header& header, std::size_t tile,
                                std::span<const std::byte, tile_coding::kTileBytes> cells) {
  { watcher.begin_frame(header) } -> std::same_as<void>;
  { watcher.take_tile(tile, cells) } -> std::same_as<void>;
  { watcher.end_frame() } -> std::same_as<void>;
};

template <Outside Out>
class Pipeline {
 public:
  // vehicle and out outlive the pipeline. start_us: the time from which silence is counted.
  Pipeline(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4, Out& out,
           std::uint64_t start_us, Coding coding = Coding::kShortest)
      : engine_(vehicle, replayer_ipv4, start_us), publisher_(coding), out_(&out) {}

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
    const auto send = [this](std::span<const std::byte> message) {
      return out_->send_message(message);
    };
    publish_tiles(header, end, send);
    end.ticks = {.fuse = ticks_.fuse, .mark = marked - start, .publish = ticks_.publish};
    end.stopwatch_hz = out_->ticks_hz();
    publisher_.publish_end(header, end, send);

    engine_.start_next(now_us);
    ticks_ = {.fuse = 0, .mark = 0, .publish = out_->ticks() - marked};
  }

  template <typename Send>
  void publish_tiles(const stream::Header& header, stream::FrameEnd& end, Send&& send) {
    if constexpr (FrameWatcher<Out>) {
      const auto show = [this](std::size_t tile, auto cells) { out_->take_tile(tile, cells); };
      out_->begin_frame(header);
      publisher_.publish_tiles(engine_.fusion(), header, end, send, show);
      out_->end_frame();
    } else {
      const auto show = [](std::size_t /*tile*/, auto /*cells*/) {};
      publisher_.publish_tiles(engine_.fusion(), header, end, send, show);
    }
  }

  FrameEngine engine_;
  Publisher publisher_;
  Out* out_;
  stream::StageTicks ticks_;
};

}  // namespace iog::app
