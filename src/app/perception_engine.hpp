// The engine of the perception grid: datagrams in, frames and classes out.
//
// It decides when a frame is over as FrameEngine does, and keeps the frame's packets until then.
// Packets that were measured together, in one slice of a few milliseconds, are then fused together
// and put into the window by the pose of that slice. The frame's own grid is the join of its
// slices: the same bytes as FrameEngine makes.
//
//     packets -> [FrameSlices] slices -> [fusion] grid of a slice -> [window] masses -> classes
//                                                   '-> [JoinedGrid] the frame's grid
//     map, newest transform -> [Layer] masks of tiles -> [window] names
//
// What has no pose is not put into the window, and is part of the frame's grid all the same. When
// the poses break off, nothing of the window is known. All of it is counted.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "app/frame_engine.hpp"
#include "app/frame_packets.hpp"
#include "app/frame_slices.hpp"
#include "app/perception_report.hpp"
#include "app/shared_fusion.hpp"
#include "grid/joined_grid.hpp"
#include "map/delivery.hpp"
#include "map/layer.hpp"
#include "pose/source.hpp"
#include "vehicle/vehicle.hpp"
#include "window/window_clock.hpp"
#include "window/window_fusion.hpp"
#include "window/window_view.hpp"
#include "work/crew.hpp"

namespace iog::app {

// Why a vehicle can have no perception grid. The compiler refuses such a description; on a PC its
// rule may be changed later.
enum class Unfit : std::uint8_t {
  kNone,
  kFusionRule,    // its fusion rule is not hits_win: slices would not join
  kQuantisation,  // its quantisation is not blurring: cells behind a hit would count as hit
};
[[nodiscard]] Unfit unfit_for_perception(const vehicle::Vehicle& vehicle);

// Holds 112 MB: belongs into static memory.
class PerceptionEngine {
 public:
  using Outcome = FrameEngine::Outcome;

  // As FrameEngine. The vehicle is fit; the replayer may send poses and maps, too.
  PerceptionEngine(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4);

  // Before the first datagram: the map that is there from the start. It outlives the engine.
  void begin_with_map(std::span<const std::uint8_t> block) { maps_.begin_with(block); }

  // Before the first datagram: silence and the window's age are counted from now on.
  void start(std::uint64_t now_us) {
    frame_.start(now_us);
    clock_.start(now_us);
  }

  // The datagram as a sensor's packet. Empty if it was a pose or of a map, or was dropped.
  [[nodiscard]] std::optional<intake::SensorPacket> receive(const intake::Datagram& datagram,
                                                            std::uint64_t now_us);
  [[nodiscard]] Outcome classify(const intake::SensorPacket& packet);
  // Keeps the packet until the frame ends: there is nothing to do yet for a crew.
  void fuse(const intake::SensorPacket& packet, std::uint64_t now_us, const work::Crew& crew);
  void leave(const intake::SensorPacket& packet) { frame_.leave(packet); }
  [[nodiscard]] bool is_complete() const { return frame_.is_complete(); }
  [[nodiscard]] bool is_overdue(std::uint64_t now_us) const { return frame_.is_overdue(now_us); }
  [[nodiscard]] std::uint64_t deadline_us() const { return frame_.deadline_us(); }

  // A frame is closed step by step. finish() completes the grid and the classes by all cores of the
  // crew, and calls lap(stage) with the stream::StageTicks that has just ended.
  template <typename Lap>
  void finish(std::uint64_t now_us, const work::Crew& crew, Lap&& lap) {
    open_slices(now_us);
    if (crew.is_one()) {
      fuse_alone(lap);
    } else {
      fuse_together(crew, lap);
    }
    lay_map();
    report_.window = window_.finish(report_.stamp_us, crew);
    contradiction_.add(report_.window.standing);
    lap(&stream::StageTicks::perceive);
  }
  [[nodiscard]] FrameReport report(std::uint64_t now_us) const { return frame_.report(now_us); }
  [[nodiscard]] const PerceptionReport& perception() const { return report_; }
  // The classes, valid until the next finish().
  [[nodiscard]] window::WindowView classes() const { return window_.view(); }
  template <typename Visit>
  void release(Visit&& visit) {
    joined_.release(visit);
  }
  void start_next(std::uint64_t now_us);

  [[nodiscard]] grid::FrameFusion& fusion() { return frame_.fusion(); }

 private:
  // One slice after the other, each tile while it is at hand.
  template <typename Lap>
  void fuse_alone(Lap&& lap) {
    for (std::size_t i = 0; i < report_.slice_count; ++i) {
      report_.packets_placed += fuse_group(static_cast<std::uint8_t>(i));
      lap(&stream::StageTicks::fuse);
      join_group(i);
      lap(&stream::StageTicks::mark);
      window_.add(window::placement_of(report_.slices[i].pose));
      lap(&stream::StageTicks::perceive);
    }
    report_.packets_not_placed = fuse_group(FrameSlices::kNowhere);
    lap(&stream::StageTicks::fuse);
    join_group(FrameSlices::kNowhere);
    lap(&stream::StageTicks::mark);
  }

  // All slices at once, as far as they fit, and then into the window.
  template <typename Lap>
  void fuse_together(const work::Crew& crew, Lap&& lap) {
    shared_.begin(packets_, report_.slice_count);
    while (shared_.fuse_next(crew, frame_)) {
      lap(&stream::StageTicks::fuse);
      shared_.join(crew, joined_);
      lap(&stream::StageTicks::mark);
      place_slices(crew);
      lap(&stream::StageTicks::perceive);
    }
    report_.packets_not_placed = shared_.packets_nowhere();
  }

  void open_slices(std::uint64_t now_us);
  void report_slices();
  void report_causes();
  std::uint32_t fuse_group(std::uint8_t group);
  void join_group(std::size_t group);
  void place_slices(const work::Crew& crew);
  void lay_map();

  // What is aligned to a cache line comes first.
  FrameEngine frame_;  // its fusion holds one slice after the other
  window::WindowFusion window_;
  SharedFusion shared_;
  grid::JoinedGrid joined_;
  map::Delivery maps_;
  map::Layer layer_;
  window::WindowClock clock_;
  FrameSlices slices_;
  PerceptionReport report_;
  pose::Source poses_;
  FramePackets packets_;
  const vehicle::Vehicle* vehicle_;
  window::Contradiction contradiction_;  // of the poses, by what they have placed
  std::uint32_t epoch_ = 0;              // of the poses that the window was made by
};

}  // namespace iog::app
