// What the pipeline needs of the machine it runs on, and what it hands its frames to.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/frame_report.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::app {

// send_message(bytes): sends a copy, at most protection::kMaxMessageBytes; false when none can go
//                   out.
// ticks(), ticks_hz(): a stopwatch, as hal::Stopwatch.
// vitals(): once for each frame, before its first message.
template <typename T>
concept Platform = requires(T& platform, std::span<const std::byte> message) {
  { platform.send_message(message) } -> std::same_as<bool>;
  { platform.ticks() } -> std::same_as<std::uint32_t>;
  { platform.ticks_hz() } -> std::same_as<std::uint32_t>;
  { platform.vitals() } -> std::same_as<Vitals>;
};

// Takes in a closed frame: what it says of itself, each tile in which something is known, in rising
// order, and that this was all. The cells are another's, and change after the call.
template <typename T>
concept FrameSink = requires(T& sink, const FrameReport& report, std::size_t tile,
                             tile_coding::TileCells cells) {
  { sink.begin_frame(report) } -> std::same_as<void>;
  { sink.take_tile(tile, cells) } -> std::same_as<void>;
  { sink.end_frame() } -> std::same_as<void>;
};

}  // namespace iog::app
