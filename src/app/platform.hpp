// What the pipeline needs of the machine it runs on, and what it hands its frames to.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/frame_report.hpp"
#include "app/perception_report.hpp"
#include "app/reception_log.hpp"
#include "tile_coding/tile_cells.hpp"
#include "window/window_view.hpp"
#include "work/round.hpp"

namespace iog::app {

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

// Takes in a closed frame: what it says of itself, each tile in which something is known, in rising
// order, and that this was all. The cells are another's, and change after the call.
template <typename T>
concept FrameSink = requires(T& sink, const FrameReport& report, std::size_t tile,
                             tile_coding::TileCells cells) {
  { sink.begin_frame(report) } -> std::same_as<void>;
  { sink.take_tile(tile, cells) } -> std::same_as<void>;
  { sink.end_frame() } -> std::same_as<void>;
};

// A sink that takes in classes, too, after the tiles of the frame's own grid. The view changes
// after the call.
template <typename T>
concept ClassSink = FrameSink<T> &&
    requires(T& sink, const PerceptionReport& report, const window::WindowView& classes) {
  { sink.take_classes(report, classes) } -> std::same_as<void>;
};

// And the things on them, after the classes.
template <typename T>
concept ObjectSink = ClassSink<T> &&
    requires(T& sink, const PerceptionReport& report, const objects::Tracks& tracks) {
  { sink.take_objects(report, tracks) } -> std::same_as<void>;
};

// And what the frame has received, after these.
template <typename T>
concept ReceptionSink = FrameSink<T> && requires(T& sink, const ReceptionLog& log) {
  { sink.take_receptions(log) } -> std::same_as<void>;
};

}  // namespace iog::app
