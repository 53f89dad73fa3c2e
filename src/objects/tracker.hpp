// Tracks moving objects, using the hits of each frame and the classes of the perception grid.
//
// A track is a moving box to which hits are assigned. A track counts as moving only if the grid
// confirms its motion (docs/objects.md). The tracker never changes the grid. The tracker performs
// the following steps for each frame:
//
//     hits -> [claim] by tracks -> [cluster] the rest -> [attach, associate] to tracks
//          -> [measure] place, speed, box -> births -> [merge] -> [judge] by classes of the grid
//
// Every step processes slots, hits (objects/frame_hits.hpp) and clusters in their order, so the
// result does not depend on the order in which hits arrive. A Tracker object takes up 2.3 MB and
// uses no other memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/claim.hpp"
#include "objects/clusters.hpp"
#include "objects/cut_views.hpp"
#include "objects/frame.hpp"
#include "objects/frame_hits.hpp"
#include "objects/grid_names.hpp"
#include "objects/grouped.hpp"
#include "objects/moving_boxes.hpp"
#include "objects/recent_hits.hpp"
#include "objects/step.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Counts the elements of a frame that were dropped because a capacity was exceeded.
struct FrameCounts {
  FrameHits::Left hits{};                // hits that were dropped
  std::uint32_t hits_not_clustered = 0;  // hits without a cluster, because all clusters were in use
  std::uint32_t tiles_crowded = 0;       // tracks that did not fit into a tile, summed over all
                                         // tiles
  std::uint32_t tracks_refused = 0;      // clusters for which no free track was available
  bool is_forgotten = false;             // all earlier tracks have ended
  friend bool operator==(const FrameCounts&, const FrameCounts&) = default;
};

class Tracker {
 public:
  Tracker() = default;
  Tracker(const Tracker&) = delete;
  Tracker& operator=(const Tracker&) = delete;

  // Processes a frame. A frame with the same end time as the previous frame has no effect. If time
  // goes backwards or advances by more than kLongestStepMs, all tracks end first. The classes that
  // `grid` returns must already reflect this frame.
  FrameCounts add(const Frame& frame, const GridNames& grid);

  // The steps of add(), for callers that split the work. `begin()` gathers the hits, predicts the
  // tracks, and needs no classes. If begin() returns false, the frame has no effect, and the other
  // steps must not be called. `look_at_hits()` looks up the classes of a range of hits(), and the
  // tracks claim these hits. Any core may call look_at_hits(), even for hits that have already been
  // looked up. `end()` updates the tracks. While end() runs, other cores must not change classes,
  // but may change all other data. `remember_hits()` stores the hits for later frames.
  bool begin(const Frame& frame);
  void look_at_hits(std::size_t first, std::size_t count, const GridNames& grid);
  FrameCounts end(const GridNames& grid);
  void remember_hits() { recent_.add(now_us_, hits_.all()); }

  // Reports that a frame ended at `end_us` without any measurements. If the time without
  // measurements exceeds kLongestToldMs, no objects are published or labelled until the next frame
  // with measurements. If the time without measurements exceeds kLongestStepMs, all tracks end. A
  // shorter pause has no effect.
  void pass(std::uint64_t end_us);

  // Ends all tracks and clears the recent hits. Call forget() if the window has lost its position.
  // Ids are not reused.
  void forget();

  // Returns the end of the last processed frame. The result is 0 if no frame has been processed
  // since start-up or the last forget(), or if pass() has hidden the objects.
  [[nodiscard]] std::uint64_t time_us() const { return is_told_ ? now_us_ : 0; }
  // Returns the tracks, indexed by slot. Some slots may be free.
  [[nodiscard]] const Tracks& tracks() const { return tracks_; }
  // Returns the hits of the last frame, sorted. The owner of a hit is the slot of its track.
  [[nodiscard]] std::span<const FrameHit> hits() const { return hits_.all(); }

  // Returns true if a hit of the last frame belongs to a moving track, unless the hit is standing
  // and the track is mostly standing (Track::is_mostly_standing()).
  [[nodiscard]] bool is_moving(const FrameHit& hit) const {
    if (hit.owner == kNobody || !is_told_) {
      return false;
    }
    const Track& track = tracks_[static_cast<std::size_t>(hit.owner)];
    return track.moves() && !(hit.stands && track.is_mostly_standing());
  }
  // Returns the cells in the set `asked` that a moving object may cover, including cells without a
  // hit. All cells are in one row. The returned cells are at most kTailMm outside the box of a
  // moving object. See MovingBoxes::hold().
  [[nodiscard]] std::uint32_t in_moving_boxes(geometry::Cell first, std::uint32_t asked) const {
    return moving_.hold(first, asked);
  }

 private:
  [[nodiscard]] bool pass_to(const Frame& frame);
  void measure_all();
  std::uint32_t give_birth();
  void judge_all(const GridNames& grid);
  void group_by_owner();
  // The hits of a track in this frame.
  [[nodiscard]] View view_of(std::size_t slot) { return {owned_.of(slot), hits_.all()}; }
  // Returns all slots up to the last one that contains a track.
  [[nodiscard]] std::span<Track> used() { return std::span(tracks_).first(used_); }
  [[nodiscard]] Track* free_slot();
  void leave_free_slots();

  Tracks tracks_{};
  std::size_t used_ = 0;
  std::uint32_t next_id_ = 1;
  FrameHits hits_{};
  RecentHits recent_{};
  Claim claim_{};
  Clusters clusters_{};
  OwnedHits owned_{};
  CutViews cut_{};
  MovingBoxes moving_{};
  // The state of the current frame.
  std::uint64_t now_us_ = 0;  // 0: no frame yet
  bool is_told_ = true;       // false: hidden by pass()
  Step step_{1};
  window::Area area_{};
  FrameCounts counts_{};
  Point car_{};
  Velocity car_velocity_{};
  std::int32_t blind_mm_ = 0;  // Frame::blind_mm while the car stands, otherwise 0
};

}  // namespace iog::objects
