// Things with a speed: from the hits of frames and the names of the perception grid.
//
// A track is a box with a velocity that takes hits. It is believed to move only if the grid agrees
// (docs/objects.md). The grid itself is not touched. In a frame
//
//     hits -> [claim] by tracks -> [cluster] what is left -> [attach, associate] to tracks
//          -> [measure] place, speed, box -> births -> [merge] -> [judge] by names of the grid
//
// Everything is done in the order of slots, of hits (objects/frame_hits.hpp) and of clusters, so
// the order in which hits come does not show. All memory is here, 2 MB.
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

// What a frame had no room for.
struct FrameCounts {
  FrameHits::Left hits{};                // that were left out
  std::uint32_t hits_not_clustered = 0;  // there were more clusters than kMostClusters
  std::uint32_t tiles_crowded = 0;       // tracks that a tile had no room for
  std::uint32_t tracks_refused = 0;      // clusters that no track was free for
  bool is_forgotten = false;             // all tracks of before have ended
  friend bool operator==(const FrameCounts&, const FrameCounts&) = default;
};

class Tracker {
 public:
  Tracker() = default;
  Tracker(const Tracker&) = delete;
  Tracker& operator=(const Tracker&) = delete;

  // Takes in a frame. A frame that ends when the one before did changes nothing. If time goes back,
  // or by more than kLongestStepMs, all tracks end first. The grid's names are those after the
  // frame.
  FrameCounts add(const Frame& frame, const GridNames& grid);

  // Its steps, for whoever divides them: begin() gathers the hits, and needs no names. False if the
  // frame changes nothing; then there is no other step. look_at_hits() asks for the names of some
  // of hits(), by whichever core, each hit once or again. end() does the rest, and may be asked
  // while what is not a name changes.
  bool begin(const Frame& frame);
  void look_at_hits(std::size_t first, std::size_t count, const GridNames& grid);
  FrameCounts end(const GridNames& grid);

  // A frame in which nothing was measured, ending then: all is as it was, until the silence is
  // longer than kLongestStepMs, which ends all tracks. So a pause of all who send leaves no trace.
  void pass(std::uint64_t end_us);

  // All tracks end, and nothing is known of what was hit: the window has lost its place. No id
  // comes again.
  void forget();

  // When the last frame ended that was taken in; 0: there is none, or all was forgotten since.
  [[nodiscard]] std::uint64_t time_us() const { return now_us_; }
  // By slot; those that are not there are free slots.
  [[nodiscard]] const Tracks& tracks() const { return tracks_; }
  // The hits of the last frame and whose they are, in their order.
  [[nodiscard]] std::span<const FrameHit> hits() const { return hits_.all(); }

  // Whether a hit of the last frame is on something that moves. One that stands is not if its track
  // is mostly standing.
  [[nodiscard]] bool is_moving(const FrameHit& hit) const {
    if (hit.owner == kNobody) {
      return false;
    }
    const Track& track = tracks_[static_cast<std::size_t>(hit.owner)];
    return track.moves() && !(hit.stands && track.is_mostly_standing());
  }
  // Of cells in a row those which may hold a part of something that moves, hit or not: at most
  // kTailMm out of its box. See MovingBoxes::hold().
  [[nodiscard]] std::uint32_t in_moving_boxes(geometry::Cell first, std::uint32_t asked) const {
    return moving_.hold(first, asked);
  }

 private:
  [[nodiscard]] bool pass_to(const Frame& frame);
  void measure_all();
  std::uint32_t give_birth();
  void judge_all(const GridNames& grid);
  void group_by_owner();
  // Behind them no slot has a track.
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
  // Of the frame at hand.
  std::uint64_t now_us_ = 0;  // 0: there was none yet
  Step step_{1};
  window::Area area_{};
  FrameCounts counts_{};
  Point car_{};
  Velocity car_velocity_{};
};

}  // namespace iog::objects
