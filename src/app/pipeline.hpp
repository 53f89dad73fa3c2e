// The pipeline turns incoming datagrams into frames and sends each frame as messages.
//
//     wire bytes -> [intake] packet -> scan points -> [fusion] grid -> tiles -> [sinks] wire bytes
//                                                       '-> [window] classes -> tiles --^
//
// The pipeline accesses the machine only through app::Platform, so the target and the PC use the
// same code. The pipeline passes each closed frame to the network sink and to any other sinks.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>

#include "app/frame.hpp"
#include "app/network_sink.hpp"
#include "app/perception_engine.hpp"
#include "app/perception_sink.hpp"
#include "app/platform.hpp"
#include "fusion/shared_fusion.hpp"
#include "hal/cores.hpp"
#include "hal/shared_cache.hpp"
#include "health/constants.hpp"
#include "health/guard.hpp"
#include "stream/message.hpp"
#include "work/crew.hpp"

namespace iog::app {

// Takes the place of PerceptionEngine for a car without classes.
struct NoPerception {
  NoPerception(const Frame& /*frame*/, const vehicle::Vehicle& /*vehicle*/,
               std::uint32_t /*replayer_ipv4*/) {}
  void start(std::uint64_t /*now_us*/) {}
  static bool receive(const intake::Datagram& /*datagram*/, std::uint64_t /*now_us*/) {
    return false;
  }
  void begin_with_map(std::span<const std::uint8_t> /*block*/) {}
  void note_left() {}
  void describe(stream::Header& /*header*/) const {}
  void start_next() {}
  template <typename Visit>
  void for_each_guard(Visit&& /*visit*/) {}
  template <typename Visit>
  void for_each_constant(Visit&& /*visit*/) const {}
};

// Perception is either PerceptionEngine or NoPerception. Every ClassSink receives the classes.
template <typename Perception, Platform P, FrameSink... Sinks>
class FramePipeline {
 public:
  // `vehicle`, `platform` and `sinks` must outlive the pipeline. The replayer at `replayer_ipv4`
  // may send on behalf of any sensor. `replayer_ipv4` is 0 if there is no replayer.
  FramePipeline(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4, P& platform,
                Coding coding, Sinks&... sinks)
      : helpers_(vehicle),
        frame_(vehicle, replayer_ipv4, helpers_.space(),
               kPerceives ? Fusing::kAtItsEnd : Fusing::kAsTheyCome),
        perception_(frame_, vehicle, replayer_ipv4),
        network_(platform, coding, vehicle.grid),
        sinks_(sinks...),
        platform_(&platform),
        keeps_cache_(!kPerceives && coding == Coding::kShortest) {}
  FramePipeline(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4, P& platform,
                Sinks&... sinks)
      : FramePipeline(vehicle, replayer_ipv4, platform, Coding::kShortest, sinks...) {}

  // Sets the map that is available from the start. Call this function before the first datagram.
  // The map must outlive the pipeline. In a pipeline without classes, this function has no effect.
  void begin_with_map(std::span<const std::uint8_t> block) { perception_.begin_with_map(block); }

  // Call this function before the first datagram. If start() is not called, time starts at 0. The
  // timer that closes an empty frame starts at now_us, so the time needed to set up the pipeline
  // does not count.
  void start(std::uint64_t now_us) {
    frame_.start(now_us);
    perception_.start(now_us);
  }

  // Handles one datagram. The function may close the frame before or after it processes the
  // datagram.
  void take(const intake::Datagram& datagram, std::uint64_t now_us) {
    begin_stage();
    take_packet(
        frame_, receive(datagram, now_us),
        [&](const intake::SensorPacket& packet) {
          if constexpr (kPerceives) {
            perception_.keep(packet, now_us);
          } else {
            frame_.fuse(packet, now_us, work::Crew(*platform_));
          }
        },
        [&] {
          end_stage(&stream::StageTicks::fuse);
          close_frame(now_us);
        });
    end_stage(&stream::StageTicks::fuse);
  }

  // Handles one datagram that has waited too long. Sensor packets are counted and shed. Poses and
  // maps are processed as usual.
  void leave(const intake::Datagram& datagram, std::uint64_t now_us) {
    begin_stage();
    if (const std::optional<intake::SensorPacket> packet = receive(datagram, now_us)) {
      perception_.note_left();
      frame_.leave(*packet);
    }
    end_stage(&stream::StageTicks::fuse);
  }

  // Closes the frame if its deadline has passed.
  void tick(std::uint64_t now_us) {
    if (frame_.is_overdue(now_us)) {
      begin_stage();
      close_frame(now_us);
    }
  }

  // `is_begun()` returns true if the current frame has packets. `deadline_us()` returns the frame's
  // deadline.
  [[nodiscard]] bool is_begun() const { return frame_.is_begun(); }
  [[nodiscard]] std::uint64_t deadline_us() const { return frame_.deadline_us(); }

  // Give observers read access.
  [[nodiscard]] const Perception& perception() const { return perception_; }
  [[nodiscard]] const ground::Grounds& grounds() const { return frame_.fusion().grounds(); }

  template <typename Visit>
  void for_each_guard(Visit&& visit) {
    visit(below_);
    helpers_.for_each_guard(visit);
    frame_.for_each_guard(visit);
    perception_.for_each_guard(visit);
    visit(behind_network_);
  }
  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    helpers_.for_each_constant(visit);
    frame_.for_each_constant(visit);
    perception_.for_each_constant(visit);
    health::visit_constants(visit, sinks_, platform_);
  }

 private:
  static constexpr bool kPerceives = !std::is_same_v<Perception, NoPerception>;
  static constexpr std::size_t kMostCores = HasOneCore<P> ? 1 : hal::kMaxCores;
  using Network = std::conditional_t<kPerceives, PerceptionSink<P>, NetworkSink<P>>;

  // These functions measure the duration of each stage. `begin_stage()` starts the timer.
  // `end_stage()` adds the elapsed time to a stage and restarts the timer for the next stage.
  using Stage = std::uint32_t stream::StageTicks::*;
  void begin_stage() { since_ = platform_->ticks(); }
  void end_stage(Stage stage) {
    const std::uint32_t now = platform_->ticks();
    ticks_.*stage += now - since_;
    since_ = now;
  }

  // Decodes the datagram as a packet from a sensor. Returns nothing if the datagram was a pose or a
  // part of a map, or if it was dropped.
  [[nodiscard]] std::optional<intake::SensorPacket> receive(const intake::Datagram& datagram,
                                                            std::uint64_t now_us) {
    return perception_.receive(datagram, now_us) ? std::nullopt : frame_.receive(datagram);
  }

  void close_frame(std::uint64_t now_us) {
    const work::Crew crew(*platform_);
    const auto lap = [this](Stage stage) { end_stage(stage); };
    if constexpr (kPerceives) {
      if (!crew.is_one()) {
        perception_.decide(now_us, crew, lap);
        lap(&stream::StageTicks::perceive);
        publish_divided(describe(now_us), crew);
        start_next(now_us);
        return;
      }
      perception_.finish(now_us, crew, lap);
    } else {
      frame_.finish(crew, lap);
    }
    publish(describe(now_us));
    start_next(now_us);
  }

  void start_next(std::uint64_t now_us) {
    frame_.start_next(now_us);
    perception_.start_next();
    ticks_ = {};
    end_stage(&stream::StageTicks::publish);
  }

  // Fills in the frame's end message, and returns the header of the frame's messages.
  [[nodiscard]] stream::Header describe(std::uint64_t now_us) {
    stream::Header header;
    stream::FrameEnd& end = network_.end();
    frame_.describe(now_us, header, end);
    perception_.describe(header);
    header.run_number = platform_->run_number();
    end.ticks = ticks_;
    end.stopwatch_hz = platform_->ticks_hz();
    const Vitals& vitals = platform_->vitals(
        {.ticks = end.ticks, .late_us = late_us(now_us), .has_packets = header.packets_fused > 0});
    header.packets_dropped += vitals.link_drops;
    end.stack_used_bytes = vitals.stack_used_bytes;
    end.temperature_dc = vitals.temperature_dc;
    end.link_counter_count = static_cast<std::uint8_t>(vitals.link_counter_count);
    end.link_counters = vitals.link_counters;
    return header;
  }

  // Returns the time since the frame's deadline.
  [[nodiscard]] std::uint32_t late_us(std::uint64_t now_us) const {
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
    const std::uint64_t deadline_us = frame_.deadline_us();
    return static_cast<std::uint32_t>(std::min(now_us - std::min(now_us, deadline_us), kMost));
  }

  // `publish()` and `publish_divided()` are not inlined, so that both can use the same stack space.
  [[gnu::noinline]] void publish(const stream::Header& header) {
    keep_cache(true);
    take_tiles(header);
    if constexpr (kPerceives) {
      perception_.describe(network_.class_end());
      network_.take_classes(perception_.classes());
      send_behind_classes(header);
      show_classes();
    }
    for_each_sink([](auto& sink) { sink.end_frame(); });
    keep_cache(false);
  }

  // Tiles and their references are used only once per frame, so they must not evict the tables and
  // beam lines from the L2 cache. The next frame needs the tables and beam lines again. Raw tiles
  // have no reference, and classes reuse most of their data. For raw tiles and classes, protecting
  // the cache would only cost time (lab/notes/2026-11-29-l2-lockdown.md).
  void keep_cache(bool keep) {
    if constexpr (hal::SharedCache<P>) {
      if (keeps_cache_) {
        platform_->keep_cache(keep);
      }
    }
  }

  // Core 0 tracks objects while the other cores encode tiles. Then core 0 sends the tiles while the
  // other cores encode the first part of the classes, and sends this part while they encode the
  // rest. Finally, core 0 sends the rest while the other cores update the ground memory.
  [[gnu::noinline]] void publish_divided(const stream::Header& header, const work::Crew& crew) {
    take_tiles(header);
    network_.encode_tiles([this] { perception_.follow_objects(); });
    perception_.describe(network_.class_end());
    network_.encode_classes(perception_.classes());
    perception_.end(crew, [&] {
      network_.send_classes();
      send_behind_classes(header);
    });
    show_classes();
    for_each_sink([](auto& sink) { sink.end_frame(); });
  }

  // Visits each known tile of the frame's grid once, and then clears the tile.
  void take_tiles(const stream::Header& header) {
    for_each_sink([&](auto& sink) { sink.begin_frame(header); });
    frame_.release([this] { return network_.tile_place(); },
                   [this](std::size_t tile, tile_coding::TileCells cells) {
                     for_each_sink([&](auto& sink) { sink.take_tile(tile, cells); });
                   });
  }

  // Sends the objects and the list of the datagrams received in the frame.
  void send_behind_classes(const stream::Header& header) {
    if (header.has_objects()) {
      perception_.list_objects(network_.objects());
      network_.send_objects();
    }
    if (header.has_receptions()) {
      network_.send_receptions(perception_.receptions());
    }
  }

  // Passes the classes to the other sinks.
  void show_classes() {
    const auto show = [this](auto& sink) {
      if constexpr (ClassSink<std::remove_reference_t<decltype(sink)>>) {
        sink.take_classes(network_.class_end(), perception_.classes());
      }
    };
    std::apply([&](Sinks&... sinks) { (show(sinks), ...); }, sinks_);
  }

  template <typename Visit>
  void for_each_sink(Visit&& visit) {
    visit(network_);
    std::apply([&](Sinks&... sinks) { (visit(sinks), ...); }, sinks_);
  }

  health::Guard below_;
  fusion::HelpersMemory<kMostCores> helpers_;
  Frame frame_;
  [[no_unique_address]] Perception perception_;
  Network network_;
  health::Guard behind_network_;
  std::tuple<Sinks&...> sinks_;
  P* platform_;
  bool keeps_cache_;
  std::uint32_t since_ = 0;
  stream::StageTicks ticks_{};  // of the current frame
};

// A pipeline without classes.
template <Platform P, FrameSink... Sinks>
using Pipeline = FramePipeline<NoPerception, P, Sinks...>;

// A pipeline that also computes the classes of the window. `unfit_for_perception()` must return
// kNone for the vehicle. The replayer may also send poses and maps.
template <Platform P, FrameSink... Sinks>
using PerceptionPipeline = FramePipeline<PerceptionEngine, P, Sinks...>;

}  // namespace iog::app
