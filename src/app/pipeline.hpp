// The pipeline: the walk of the data, from a datagram to the last message of its frame.
//
//     wire bytes -> [intake] packet -> scan points -> [fusion] grid -> tiles -> [sinks] wire bytes
//
// The machine comes through one seam, app::Platform, so that the target and the PC run this very
// file. A closed frame goes to the network, and to whatever other sinks there are.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>

#include "app/frame_engine.hpp"
#include "app/network_sink.hpp"
#include "app/platform.hpp"

namespace iog::app {

template <Platform P, FrameSink... Sinks>
class Pipeline {
 public:
  // vehicle, platform and sinks outlive the pipeline. start_us: the time from which silence is
  // counted.
  Pipeline(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4, P& platform,
           std::uint64_t start_us, Coding coding, Sinks&... sinks)
      : engine_(vehicle, replayer_ipv4, start_us),
        network_(platform, coding),
        sinks_(sinks...),
        platform_(&platform) {}
  Pipeline(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4, P& platform,
           std::uint64_t start_us, Sinks&... sinks)
      : Pipeline(vehicle, replayer_ipv4, platform, start_us, Coding::kShortest, sinks...) {}

  // One datagram. Closes the frame before it, after it, or not at all.
  void take(const intake::Datagram& datagram, std::uint64_t now_us) {
    using Outcome = FrameEngine::Outcome;
    std::uint32_t start = platform_->ticks();
    const std::optional<intake::SensorPacket> packet = engine_.receive(datagram);
    Outcome outcome = packet ? engine_.classify(*packet) : Outcome::kDropped;
    if (outcome == Outcome::kNextFrame) {
      ticks_.fuse += platform_->ticks() - start;
      close_frame(now_us);
      start = platform_->ticks();
      outcome = engine_.classify(*packet);
    }
    if (outcome == Outcome::kThisFrame) {
      engine_.fuse(*packet, now_us);
    }
    ticks_.fuse += platform_->ticks() - start;
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
  void close_frame(std::uint64_t now_us) {
    const std::uint32_t start = platform_->ticks();
    engine_.finish();
    const std::uint32_t finished = platform_->ticks();
    ticks_.mark = finished - start;
    publish(report(now_us));
    engine_.start_next(now_us);
    ticks_ = {.fuse = 0, .mark = 0, .publish = platform_->ticks() - finished};
  }

  [[nodiscard]] FrameReport report(std::uint64_t now_us) {
    FrameReport report = engine_.report(now_us);
    report.ticks = ticks_;
    report.ticks_hz = platform_->ticks_hz();
    report.vitals = platform_->vitals();
    return report;
  }

  // The engine owns the grid: it shows each known tile once, and clears it.
  void publish(const FrameReport& report) {
    for_each_sink([&](auto& sink) { sink.begin_frame(report); });
    engine_.release([this](std::size_t tile, tile_coding::TileCells cells) {
      for_each_sink([&](auto& sink) { sink.take_tile(tile, cells); });
    });
    for_each_sink([](auto& sink) { sink.end_frame(); });
  }

  template <typename Visit>
  void for_each_sink(Visit&& visit) {
    visit(network_);
    std::apply([&](Sinks&... sinks) { (visit(sinks), ...); }, sinks_);
  }

  FrameEngine engine_;
  NetworkSink<P> network_;
  std::tuple<Sinks&...> sinks_;
  P* platform_;
  stream::StageTicks ticks_;
};

}  // namespace iog::app
