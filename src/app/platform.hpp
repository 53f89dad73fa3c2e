// What the pipeline needs of the machine it runs on, and what it hands its frames to.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/thermometer.hpp"
#include "stream/class_end.hpp"
#include "stream/message.hpp"
#include "tile_coding/tile_cells.hpp"
#include "window/window_view.hpp"
#include "work/round.hpp"

namespace iog::app {

// How the platform is.
struct Vitals {
  std::uint32_t stack_used_bytes = 0;  // deepest so far
  std::uint32_t link_drops = 0;        // datagrams that the link itself has dropped, since start
  std::int16_t temperature_dc = hal::kTemperatureNotKnown;  // of the chip, 1/10 degree Celsius
  std::size_t link_counter_count = 0;
  std::array<std::uint32_t, stream::kMaxLinkCounters>
      link_counters{};  // since start, as docs/spec.md
};

// What a frame has taken.
struct FrameTimes {
  stream::StageTicks ticks{};  // publish: that of the frame before
  std::uint32_t late_us = 0;   // how long after its deadline it was closed
  bool has_packets = false;
};

// send_message(bytes): sends a copy, at most protection::kMaxMessageBytes; false when none can go
//                   out.
// ticks(), ticks_hz(): a stopwatch, as hal::Stopwatch.
// vitals(times): once for each frame, before its first message.
// run_number(): as hal::RunNumber.
// cores(): how many work now; share(items, work, beside): does them all, as work::Team.
template <typename T>
concept Platform = requires(T& platform, std::span<const std::byte> message, std::size_t items,
                            work::Work work, work::Beside beside, const FrameTimes& times) {
  { platform.send_message(message) } -> std::same_as<bool>;
  { platform.ticks() } -> std::same_as<std::uint32_t>;
  { platform.ticks_hz() } -> std::same_as<std::uint32_t>;
  { platform.vitals(times) } -> std::convertible_to<const Vitals&>;
  { platform.run_number() } -> std::same_as<std::uint32_t>;
  { platform.cores() } -> std::same_as<std::size_t>;
  { platform.share(items, work, beside) } -> std::same_as<void>;
};

// A platform that says so: it will never have more than one.
template <typename T>
concept HasOneCore = requires {
  requires T::kMostCores == 1;
};

// Takes in a closed frame: the header of its messages, whose type and number do not matter, each
// tile in which something is known, in rising order, and that this was all. The cells are
// another's, and change after the call.
template <typename T>
concept FrameSink = requires(T& sink, const stream::Header& header, std::size_t tile,
                             tile_coding::TileCells cells) {
  { sink.begin_frame(header) } -> std::same_as<void>;
  { sink.take_tile(tile, cells) } -> std::same_as<void>;
  { sink.end_frame() } -> std::same_as<void>;
};

// A sink that takes in classes, too, after the tiles of the frame's own grid. The view changes
// after the call.
template <typename T>
concept ClassSink = FrameSink<T> &&
    requires(T& sink, const stream::ClassEnd& end, const window::WindowView& classes) {
  { sink.take_classes(end, classes) } -> std::same_as<void>;
};

}  // namespace iog::app
