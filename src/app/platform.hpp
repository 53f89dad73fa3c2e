// Defines the interface that the pipeline requires of its machine, and the interfaces of the sinks
// that receive the pipeline's frames.
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

// The state of the platform.
struct Vitals {
  std::uint32_t stack_used_bytes = 0;  // greatest depth so far
  std::uint32_t link_drops = 0;        // datagrams dropped by the link itself, since start-up
  std::int16_t temperature_dc = hal::kTemperatureNotKnown;  // of the chip, 1/10 degree Celsius
  std::size_t link_counter_count = 0;
  std::array<std::uint32_t, stream::kMaxLinkCounters>
      link_counters{};  // since start-up, in the order of docs/spec.md
};

// Processing times of a frame.
struct FrameTimes {
  stream::StageTicks ticks{};  // publish: of the previous frame
  std::uint32_t late_us = 0;   // delay between the frame's deadline and its closing
  bool has_packets = false;
};

// `send_message(bytes)` copies and sends a message of at most protection::kMaxMessageBytes bytes.
// `send_message()` returns false if the message cannot be sent. Together, ticks() and ticks_hz()
// form a stopwatch, like hal::Stopwatch. `vitals(times)` is called once per frame, before the
// frame's first message. `run_number()` is the same function as in hal::RunNumber. `cores()`
// returns the number of working cores. `share(items, work, beside)` runs all items, just as
// work::Team does.
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

// A platform that never has more than one core.
template <typename T>
concept HasOneCore = requires {
  requires T::kMostCores == 1;
};

// A FrameSink receives a closed frame: first the header of the frame's messages, then each tile
// with a known cell, in ascending order, and finally the end of the frame. The sink ignores the
// message type and the sequence number in the header. The cells belong to the caller and may change
// after the call.
template <typename T>
concept FrameSink = requires(T& sink, const stream::Header& header, std::size_t tile,
                             tile_coding::TileCells cells) {
  { sink.begin_frame(header) } -> std::same_as<void>;
  { sink.take_tile(tile, cells) } -> std::same_as<void>;
  { sink.end_frame() } -> std::same_as<void>;
};

// A sink that also receives classes, after the tiles of the frame's own grid. The view is valid
// only during the call.
template <typename T>
concept ClassSink = FrameSink<T> &&
    requires(T& sink, const stream::ClassEnd& end, const window::WindowView& classes) {
  { sink.take_classes(end, classes) } -> std::same_as<void>;
};

}  // namespace iog::app
