// Computes the perception grid of a frame (app/frame.hpp) from poses, maps and the frame's packets.
//
// The engine buffers the packets until the frame ends. Then the engine fuses all packets that were
// measured in the same slice of a few milliseconds, and adds the result to the window using the
// pose of the slice. The frame's own grid is assembled from the grids of its slices. This grid is
// byte-for-byte identical to the grid that results from fusing the packets on arrival.
//
//     packets -> [FrameSlices] slices -> [fusion] grid of a slice -> [window] masses -> classes
//                                                   '-> [JoinedGrid] the frame's grid
//     map, newest transform -> [Layer] masks of tiles -> [window] names
//
// Packets without a pose are fused into the frame's grid, but are not added to the window. If the
// sequence of poses is broken, the entire window is reset to unknown. The engine counts both cases.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "app/frame.hpp"
#include "app/object_follower.hpp"
#include "app/reception_log.hpp"
#include "fusion/frame_slices.hpp"
#include "fusion/fused_slices.hpp"
#include "health/guard.hpp"
#include "map/delivery.hpp"
#include "map/layer.hpp"
#include "perception/window_clock.hpp"
#include "perception/window_fusion.hpp"
#include "pose/source.hpp"
#include "stream/class_end.hpp"
#include "stream/message.hpp"
#include "stream/objects.hpp"
#include "vehicle/vehicle.hpp"
#include "window/window_view.hpp"
#include "work/crew.hpp"

namespace iog::app {

// The reason why a vehicle cannot have a perception grid. The car file compiler rejects such a
// vehicle. On a PC, however, the fusion rule can still be changed after the car file has been
// compiled.
enum class Unfit : std::uint8_t {
  kNone,
  kFusionRule,    // its fusion rule is not hits_win: slices could not be joined
  kQuantisation,  // its quantisation is not blurring: cells behind a hit would be treated as hit
};
[[nodiscard]] Unfit unfit_for_perception(const vehicle::Vehicle& vehicle);

// A PerceptionEngine uses 32 MB, so it must be in static memory.
class PerceptionEngine {
 public:
  // All arguments must outlive the engine. The frame must be constructed with Fusing::kAtItsEnd,
  // and unfit_for_perception() must return kNone for the vehicle. The replayer may also send poses
  // and maps.
  PerceptionEngine(Frame& frame, const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4);

  // Sets the map that is available from the start. Call this function before the first datagram.
  // The map must outlive the engine.
  void begin_with_map(std::span<const std::uint8_t> block) { maps_.begin_with(block); }

  // Call this function before the first datagram. The window's clock starts from 0 at the time
  // `now_us`.
  void start(std::uint64_t now_us) { clock_.start(now_us); }

  // Returns true if the datagram was a pose or a part of a map. The function also logs all
  // datagrams that the frame receives.
  [[nodiscard]] bool receive(const intake::Datagram& datagram, std::uint64_t now_us);
  // Records that the latest packet was shed because it had waited too long.
  void note_left() { receptions_.note_left(); }
  // Buffers a packet that belongs to the frame.
  void keep(const intake::SensorPacket& packet, std::uint64_t now_us);

  // Closes the frame. Completes the grid and the classes, using all cores of the crew. After each
  // stage, finish() calls lap() with that stage's member of stream::StageTicks.
  template <typename Lap>
  void finish(std::uint64_t now_us, const work::Crew& crew, Lap&& lap) {
    decide(now_us, crew, lap);
    follow_objects();
    end(crew, [] {});
    lap(&stream::StageTicks::perceive);
  }
  // `decide()`, `follow_objects()` and `end()` are the three steps of finish(). Callers that call
  // these steps individually can run other tasks in parallel. `decide()` completes the grid and all
  // classes except those of moving objects. `follow_objects()` adds the classes of moving objects
  // on core 0. Other cores may read the grid while follow_objects() runs. `end()` updates the
  // ground memory. While end() runs, core 0 runs do_beside(), which may read the classes.
  template <typename Lap>
  void decide(std::uint64_t now_us, const work::Crew& crew, Lap&& lap) {
    receptions_.close(now_us);
    open_slices(now_us);
    if (crew.is_one()) {
      fuse_alone(lap);
    } else {
      fuse_together(crew, lap);
    }
    frame_->end_fusion();
    lay_map();
    window_.decide(clock_.stamp_us(), crew, [this] { begin_following(); });
    look_at_hits(crew);
    counts_ = window_.counts();
    contradiction_.add(counts_.standing);
  }
  void follow_objects();
  template <typename DoBeside>
  void end(const work::Crew& crew, DoBeside&& do_beside) {
    window_.end_frame(crew, [&] {
      do_beside();
      if (is_following_) {
        follower_.remember_hits();
      }
    });
  }
  // `describe()` fills in the engine's fields in the frame's header or in the class end message.
  // `list_objects()` lists the tracked objects.
  void describe(stream::Header& header) const;
  void describe(stream::ClassEnd& end) const;
  void list_objects(stream::ObjectList& list) const;

  // `slices()` returns the registered slices. `stamp_us()` returns the time at which the frame
  // ended, on the clock of the poses. A frame ends at the end of its last slice. A frame without
  // packets ends at the time of the newest pose. The value of stamp_us() never decreases, even if
  // the clock of the poses restarts or is unknown. `is_forgotten()` returns true if the window was
  // reset to unknown in this frame.
  [[nodiscard]] std::span<const fusion::PlacedSlice> slices() const { return slices_.placed(); }
  [[nodiscard]] std::uint64_t stamp_us() const { return clock_.stamp_us(); }
  [[nodiscard]] bool is_forgotten() const { return is_forgotten_; }
  // Returns the classes, which are valid until the next finish().
  [[nodiscard]] window::WindowView classes() const { return window_.view(); }
  // Returns the tracked objects, which are valid until the next finish(). If the car file disables
  // object tracking, there are no tracked objects.
  [[nodiscard]] const objects::Tracker& objects() const { return follower_.tracker(); }
  [[nodiscard]] const objects::FrameCounts& object_counts() const { return object_counts_; }
  // Returns the log of the datagrams received in the frame. The log is valid until the next
  // finish(). Datagrams are recorded only if the vehicle's classes depend on arrival times.
  [[nodiscard]] const ReceptionLog& receptions() const { return receptions_; }
  void start_next() { receptions_.clear(); }

  template <typename Visit>
  void for_each_guard(Visit&& visit) {
    visit(behind_fused_);
    window_.for_each_guard(visit);
    visit(behind_follower_);
    visit(behind_maps_);
  }
  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    fused_.for_each_constant(visit);
    window_.for_each_constant(visit);
    maps_.for_each_constant(visit);
    poses_.for_each_constant(visit);
    health::visit_constants(visit, frame_, vehicle_);
  }

 private:
  // Fuses the slices one after another. Each tile is read while it is still in the cache.
  template <typename Lap>
  void fuse_alone(Lap&& lap) {
    const std::span<const fusion::PlacedSlice> placed = slices_.placed();
    for (std::size_t i = 0; i < placed.size(); ++i) {
      fuse_group(static_cast<std::uint8_t>(i));
      lap(&stream::StageTicks::fuse);
      join_group(i);
      lap(&stream::StageTicks::mark);
      const placing::PlacedCells slice{.cells = &fused_.one(),
                                       .at = placing::placement_of(placed[i].pose, vehicle_->grid),
                                       .number = static_cast<std::uint8_t>(i)};
      window_.add(std::span(&slice, 1));
      lap(&stream::StageTicks::perceive);
    }
    fuse_group(fusion::FrameSlices::kNowhere);
    lap(&stream::StageTicks::fuse);
    join_group(fusion::FrameSlices::kNowhere);
    lap(&stream::StageTicks::mark);
  }

  // Repeatedly fuses as many slices as fit into memory, and adds them to the window.
  template <typename Lap>
  void fuse_together(const work::Crew& crew, Lap&& lap) {
    fusion::SharedFusion& fusion = frame_->fusion();
    fusion.deal(slices_.placed().size(), fusion::FrameParts::kMostOfARound);
    while (fusion.fuse_next(crew)) {
      lap(&stream::StageTicks::fuse);
      fusion.join(crew);
      lap(&stream::StageTicks::mark);
      place_slices(crew);
      lap(&stream::StageTicks::perceive);
    }
  }

  void open_slices(std::uint64_t now_us);
  void fuse_group(std::uint8_t group);
  void join_group(std::size_t group);
  void place_slices(const work::Crew& crew);
  void lay_map();
  void begin_following();
  void look_at_hits(const work::Crew& crew);

  // Members aligned to a cache line come first.
  fusion::FusedSlices fused_;
  health::Guard behind_fused_;
  perception::WindowFusion window_;
  ObjectFollower follower_;
  health::Guard behind_follower_;
  map::Delivery maps_;
  map::Layer layer_;
  health::Guard behind_maps_;
  fusion::FrameSlices slices_;
  pose::Source poses_;
  ReceptionLog receptions_;
  Frame* frame_;
  const vehicle::Vehicle* vehicle_;
  perception::WindowClock clock_;
  perception::Contradiction contradiction_;  // of the poses, detected from the slices that they
                                             // registered
  std::uint32_t epoch_ = 0;                  // epoch of the poses in the window
  // Of the current frame.
  bool is_forgotten_ = false;
  pose::CauseCounts causes_{};  // since start-up; causes_before_: up to the previous frame
  pose::CauseCounts causes_before_{};
  pose::Placed end_{};
  std::uint64_t frame_end_us_ = 0;  // the middle of the frame's last slice; 0 if nothing is tracked
  bool is_following_ = false;       // there are hits to track
  objects::FrameCounts object_counts_{};
  perception::FrameCounts counts_{};
};

}  // namespace iog::app
