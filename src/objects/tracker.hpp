// Tracks moving objects from the hits of each frame and the classes of the perception grid.
//
// A track is a box with a velocity that takes hits. It counts as moving only if the grid confirms
// it (docs/objects.md). The tracker never changes the grid. Each frame runs these steps:
//
//     hits -> [claim] by tracks -> [cluster] the rest -> [attach, associate] to tracks
//          -> [measure] place, speed, box -> births -> [merge] -> [judge] by classes of the grid
//
// Every step follows the order of slots, hits (objects/frame_hits.hpp) and clusters, so the result
// does not depend on the order in which hits arrive. All memory is in this class, 2 MB.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/claim.hpp"
#include "objects/clusters.hpp"
#include "objects/frame.hpp"
#include "objects/frame_hits.hpp"
#include "objects/grid_names.hpp"
#include "objects/grouped.hpp"
#include "objects/moving_boxes.hpp"
#include "objects/recent_hits.hpp"
#include "objects/step.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// What a frame dropped for lack of room.
struct FrameCounts {
  FrameHits::Left hits{};                // hits that were dropped
  std::uint32_t hits_not_clustered = 0;  // hits without a cluster, for lack of room
  std::uint32_t tiles_crowded = 0;       // tracks that found no room in a tile, counted per tile
  std::uint32_t tracks_refused = 0;      // clusters for which no track was free
  bool is_forgotten = false;             // all earlier tracks have ended
  friend bool operator==(const FrameCounts&, const FrameCounts&) = default;
};

class Tracker {
 public:
  Tracker() = default;
  Tracker(const Tracker&) = delete;
  Tracker& operator=(const Tracker&) = delete;

  // Processes a frame. A frame with the end time of the previous one changes nothing. If time runs
  // back, or advances by more than kLongestStepMs, all tracks end first. `grid` must give the
  // classes after the frame.
  FrameCounts add(const Frame& frame, const GridNames& grid);

  // The steps of add(), for callers that divide the work. begin() gathers the hits and needs no
  // classes. If it returns false, the frame changes nothing and the other steps must not be called.
  // look_at_hits() looks up the classes of a range of hits(). Any core may call it, and hits may be
  // looked up twice. end() does the rest. Data other than classes may change while it runs.
  bool begin(const Frame& frame);
  void look_at_hits(std::size_t first, std::size_t count, const GridNames& grid);
  FrameCounts end(const GridNames& grid);

  // Reports a frame without measurements that ends at `end_us`. Tracks stay as they are until the
  // silence exceeds kLongestStepMs; then all end. So a shorter pause of all senders has no effect.
  void pass(std::uint64_t end_us);

  // Ends all tracks and forgets recent hits, because the window has lost its place. Ids are not
  // reused.
  void forget();

  // End of the last processed frame; 0: none since the start or forget().
  [[nodiscard]] std::uint64_t time_us() const { return now_us_; }
  // By slot. Slots without a track are free.
  [[nodiscard]] const Tracks& tracks() const { return tracks_; }
  // The hits of the last frame with their owners, in order.
  [[nodiscard]] std::span<const FrameHit> hits() const { return hits_.all(); }

  // Whether a hit of the last frame is on a moving track. Standing hits are not if the track is
  // mostly standing.
  [[nodiscard]] bool is_moving(const FrameHit& hit) const {
    if (hit.owner == kNobody) {
      return false;
    }
    const Track& track = tracks_[static_cast<std::size_t>(hit.owner)];
    return track.moves() && !(hit.stands && track.is_mostly_standing());
  }
  // Which of the cells in a row may be covered by a moving object, hit or not: those at most
  // kTailMm outside its box. See MovingBoxes::hold().
  [[nodiscard]] std::uint32_t in_moving_boxes(geometry::Cell first, std::uint32_t asked) const {
    return moving_.hold(first, asked);
  }

 private:
  [[nodiscard]] bool pass_to(const Frame& frame);
  void measure_all();
  std::uint32_t give_birth();
  void judge_all(const GridNames& grid);
  void group_by_owner();
  // All slots up to the last one with a track.
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
  MovingBoxes moving_{};
  // State of the current frame.
  std::uint64_t now_us_ = 0;  // 0: no frame yet
  Step step_{1};
  window::Area area_{};
  FrameCounts counts_{};
  Point car_{};
  Velocity car_velocity_{};
};

}  // namespace iog::objects
