// Joins the two parts of a view that the end of a frame has cut.
//
// A frame of a spinning lidar covers a part of a turn. If the end of a frame cuts an object, the
// newest slice of the frame has hits of the object, and so has the oldest slice of the next frame.
// The cut edge of each part is not an end of the object, and the beams of one part pass only some
// of the places that the object has left. When the first part is seen, it is unknown whether the
// object goes on, so the first part is processed like any other view. If the object does go on in
// the next frame, these changes of its track are undone, and both parts are processed as one view.
//
// A frame of a whole turn may see an object twice: its rest in the oldest slices, and its first
// part in the newest slices, almost a turn later. Then only the older hits are processed. The newer
// hits wait for the next frame, so that each view has one sweep over the object. They are dropped
// if the object is not in the oldest slice of the next frame.
//
// If a track takes over another one, its changes stay, because the other track is gone.
//
// Only the tracks in the lowest slots and at most kMostCutHits hits are kept for the next frame,
// waiting hits first. The views of other tracks stay in two parts, or have two sweeps.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/grouped.hpp"
#include "objects/hit.hpp"
#include "objects/plane.hpp"
#include "objects/rules.hpp"
#include "objects/step.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// The view of a track: indices of its hits, and the array to which they refer.
struct View {
  std::span<const std::uint16_t> numbers{};
  std::span<FrameHit> hits{};
};

class CutViews {
 public:
  // Begins a frame. `ages_ms` contains the age of each slice.
  void begin(std::span<const std::uint8_t> ages_ms, Step step);

  // Returns the view of the track in a slot, without hits that wait for the next frame. `now` is
  // its view in this frame. If it goes on from a part that was processed in the last frame, the
  // track is first restored and predicted to the end of this frame.
  View join(std::size_t slot, Point car, View now, Track& track);
  // Copies the owners of hits from the view that join() has returned to those of the frame.
  void give_back(std::size_t slot, View now) const;
  // Returns the joined view of a track, or `now` if it was not joined.
  [[nodiscard]] View view_of(std::size_t slot, View now);

  // Keeps the hits of tracks whose view may go on. `tracks` are indexed by slot, and `hits` are
  // those of the frame. Call keep() at the end of each frame.
  void keep(std::span<const Track> tracks, std::span<const FrameHit> hits);
  void forget();

 private:
  static constexpr std::uint8_t kNone = 0xFF;
  static constexpr std::int32_t kAll = 0x100;  // above every age

  // Tracks before their part of a frame, by slot.
  struct Kept {
    std::size_t count = 0;
    std::array<Track, kMostCutTracks> tracks{};
    std::array<std::int32_t, kMostCutTracks> below_ms{};
    std::array<std::uint8_t, kMostTracks> of_slot{};

    // Returns the age in ms below which the hits of a track are kept: kAll if its view was
    // processed and may go on, less if only younger hits wait, 0 if no hit is kept.
    [[nodiscard]] std::int32_t waits_below(std::size_t slot) const {
      return of_slot[slot] == kNone ? 0 : below_ms[of_slot[slot]];
    }
  };
  struct Range {
    std::size_t first = 0;
    std::size_t count = 0;
  };

  [[nodiscard]] bool goes_on(std::size_t slot, const View& now, const Track& track) const;
  [[nodiscard]] std::int32_t older_sweep_of(const View& view) const;
  void undo(std::size_t slot, Point car, Track& track) const;
  void keep_track(std::size_t slot, const Track& track, std::int32_t below_ms);
  void add(std::size_t slot, const Track& track, const FrameHit& hit, std::int32_t more_ms);

  std::int32_t newest_ms_ = 0;
  std::int32_t oldest_ms_ = 0;
  Step step_{1};
  bool is_adjacent_ = false;       // the frame begins where the last one ended
  std::array<Kept, 2> kept_{};     // of this frame and the last one
  std::size_t now_ = 0;            // which one is of this frame
  std::size_t waiting_count_ = 0;  // hits of this frame that wait for the next one
  std::size_t carried_count_ = 0;
  std::array<FrameHit, kMostCutHits> carried_{};
  OwnedHits carried_of_{};
  std::size_t joined_count_ = 0;
  std::array<Range, kMostTracks> joined_of_{};
  std::array<std::uint16_t, 2 * kMostCutHits> numbers_{};
  std::array<FrameHit, 2 * kMostCutHits> joined_{};
};

}  // namespace iog::objects
