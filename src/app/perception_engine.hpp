// The perception grid behind a frame (app/frame.hpp): poses and maps in, classes out.
//
// The frame's packets are kept until it is over. Packets that were measured together, in one
// slice of a few milliseconds, are then fused together and put into the window by the pose of that
// slice. The frame's own grid is the join of its slices: the same bytes as if they were fused as
// they come.
//
//     packets -> [FrameSlices] slices -> [fusion] grid of a slice -> [window] masses -> classes
//                                                   '-> [JoinedGrid] the frame's grid
//     map, newest transform -> [Layer] masks of tiles -> [window] names
//
// What has no pose is not put into the window, and is part of the frame's grid all the same. When
// the poses break off, nothing of the window is known. All of it is counted.
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

// Why a vehicle can have no perception grid. The compiler refuses such a description; on a PC its
// rule may be changed later.
enum class Unfit : std::uint8_t {
  kNone,
  kFusionRule,    // its fusion rule is not hits_win: slices would not join
  kQuantisation,  // its quantisation is not blurring: cells behind a hit would count as hit
};
[[nodiscard]] Unfit unfit_for_perception(const vehicle::Vehicle& vehicle);

// Holds 32 MB: belongs into static memory.
class PerceptionEngine {
 public:
  // They outlive it. The frame is fused at its end; the vehicle is fit; the replayer may send poses
  // and maps, too.
  PerceptionEngine(Frame& frame, const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4);

  // Before the first datagram: the map that is there from the start. It outlives the engine.
  void begin_with_map(std::span<const std::uint8_t> block) { maps_.begin_with(block); }

  // Before the first datagram: the window's age is counted from now on.
  void start(std::uint64_t now_us) { clock_.start(now_us); }

  // Whether the datagram was a pose or of a map. What the frame receives is noted.
  [[nodiscard]] bool receive(const intake::Datagram& datagram, std::uint64_t now_us);
  // The packet that came last has waited too long.
  void note_left() { receptions_.note_left(); }
  // The frame keeps a packet that belongs to it.
  void keep(const intake::SensorPacket& packet, std::uint64_t now_us);

  // When the frame is closed. finish() completes the grid and the classes by all cores of the crew,
  // and calls lap(stage) with the stream::StageTicks that has just ended.
  template <typename Lap>
  void finish(std::uint64_t now_us, const work::Crew& crew, Lap&& lap) {
    decide(now_us, crew, lap);
    follow_objects();
    end(crew, [] {});
    lap(&stream::StageTicks::perceive);
  }
  // Its three steps, for whoever has something to do for other cores, or for core 0, meanwhile.
  // decide() completes the grid, and the classes but for the names of things that move.
  // follow_objects(), core 0's, gives those; meanwhile the grid may be read. end() remembers the
  // ground; do_beside(), which may read the classes, is done beside it by core 0.
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
    window_.end_frame(crew, do_beside);
  }
  // What it knows of the frame's header, and of the end of its classes, goes there; and the things
  // with a speed that are told.
  void describe(stream::Header& header) const;
  void describe(stream::ClassEnd& end) const;
  void list_objects(stream::ObjectList& list) const;

  // The slices that were placed. The frame's end on the clock of the poses: that of its last slice,
  // or the newest pose if it has no packets; it goes on from frame to frame also where that clock
  // begins anew or is not known. Whether what was known before the frame has lost its place.
  [[nodiscard]] std::span<const fusion::PlacedSlice> slices() const { return slices_.placed(); }
  [[nodiscard]] std::uint64_t stamp_us() const { return clock_.stamp_us(); }
  [[nodiscard]] bool is_forgotten() const { return is_forgotten_; }
  // The classes, valid until the next finish().
  [[nodiscard]] window::WindowView classes() const { return window_.view(); }
  // The things with a speed, likewise; none if the car's description switches them off.
  [[nodiscard]] const objects::Tracker& objects() const { return follower_.tracker(); }
  [[nodiscard]] const objects::FrameCounts& object_counts() const { return object_counts_; }
  // What the frame has received, likewise; of a vehicle whose classes depend on when that was.
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
    window_.for_each_constant(visit);
    maps_.for_each_constant(visit);
    poses_.for_each_constant(visit);
    health::visit_constants(visit, frame_, vehicle_);
  }

 private:
  // One slice after the other, each tile while it is at hand.
  template <typename Lap>
  void fuse_alone(Lap&& lap) {
    const std::span<const fusion::PlacedSlice> placed = slices_.placed();
    for (std::size_t i = 0; i < placed.size(); ++i) {
      fuse_group(static_cast<std::uint8_t>(i));
      lap(&stream::StageTicks::fuse);
      join_group(i);
      lap(&stream::StageTicks::mark);
      const placing::PlacedCells slice{.cells = &fused_.one(),
                                       .at = placing::placement_of(placed[i].pose),
                                       .number = static_cast<std::uint8_t>(i)};
      window_.add(std::span(&slice, 1));
      lap(&stream::StageTicks::perceive);
    }
    fuse_group(fusion::FrameSlices::kNowhere);
    lap(&stream::StageTicks::fuse);
    join_group(fusion::FrameSlices::kNowhere);
    lap(&stream::StageTicks::mark);
  }

  // All slices at once, as far as they fit, and then into the window.
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

  // What is aligned to a cache line comes first.
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
  perception::Contradiction contradiction_;  // of the poses, by what they have placed
  std::uint32_t epoch_ = 0;                  // of the poses that the window was made by
  // Of the frame at hand.
  bool is_forgotten_ = false;
  pose::CauseCounts causes_{};  // since start, and those before the frame
  pose::CauseCounts causes_before_{};
  pose::Placed end_{};
  std::uint64_t frame_end_us_ = 0;  // the middle of its last slice; 0: nothing is followed
  bool is_following_ = false;       // there are hits to follow
  objects::FrameCounts object_counts_{};
  perception::FrameCounts counts_{};
};

}  // namespace iog::app
