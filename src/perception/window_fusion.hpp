// The window in time: slices of frames in, masses and classes out.
//
// In a frame the window follows the vehicle, slices are added, and the frame is finished:
//   1. what is asked of neighbours is answered from the state before the frame, and where ground is
//      opened only from below (perception/opening.hpp) what does not count is left out;
//   2. groups with evidence age, take it in, and are decided;
//   3. the tiles of which slot and number of frames, since the first that was placed, are a
//   multiple of 8 in sum are refreshed: its other groups age and are decided without evidence;
//   4. who follows things names what moves (perception/moving_names.hpp);
//   5. if a slice was placed, the frame counts as fused, and the tiles of which slot and number of
//      fused frames, this one included, are even in sum remember their ground.
// Nothing depends on the order of slices or tiles.
//
// Each step is a round of its own, divided into runs of tiles; ageing, evidence and refresh are one
// step of a tile. What a step asks of neighbours, none of its items writes.
//
// A frame has a budget of groups. Those with hits come first, then the others, each in the order of
// slots and numbers; what is beyond the budget is left, and ages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "ageing/clock.hpp"
#include "health/constants.hpp"
#include "health/guard.hpp"
#include "perception/arrivals.hpp"
#include "perception/ground.hpp"
#include "perception/moving_names.hpp"
#include "perception/opening.hpp"
#include "perception/rules.hpp"
#include "perception/standing.hpp"
#include "perception/tile_before.hpp"
#include "perception/tile_fusion.hpp"
#include "perception/tile_update.hpp"
#include "placing/frame_evidence.hpp"
#include "placing/hit_list.hpp"
#include "placing/placement.hpp"
#include "placing/slice_cells.hpp"
#include "pose/pose.hpp"
#include "window/window.hpp"
#include "window/window_view.hpp"
#include "work/before_images.hpp"
#include "work/crew.hpp"
#include "work/runs.hpp"

namespace iog::perception {

// Every tile is refreshed once in so many frames.
inline constexpr std::uint32_t kRefreshFrames = 8;

struct FrameCounts {
  std::uint32_t slices = 0;          // placed
  std::uint32_t slices_outside = 0;  // not placed: the vehicle is not in the window
  std::uint32_t groups_fused = 0;
  std::uint32_t groups_left = 0;       // they had evidence, but were over budget
  std::uint32_t groups_refreshed = 0;  // without evidence
  StandingCounts standing{};
  friend bool operator==(const FrameCounts&, const FrameCounts&) = default;
};

class WindowFusion {
 public:
  // Not constexpr: in static memory it is set up at start-up, not carried by the image.
  // is_followed: things are followed, so hits of a frame are listed, and names may be said.
  explicit WindowFusion(const Rules& rules = {}, bool is_followed = false);
  WindowFusion(const WindowFusion&) = delete;
  WindowFusion& operator=(const WindowFusion&) = delete;

  // Once a frame, before its first slice: the window follows the vehicle. Before the first time,
  // and after forget(), slices are outside.
  void follow(const pose::Pose& pose);

  // Adds slices, at most FrameEvidence::kMostAtOnce.
  void add(std::span<const placing::PlacedCells> slices, const work::Crew& crew = work::Crew());

  // Ends a frame, whether slices were placed or not. A stamp that is older than the newest counts
  // as the newest. A frame without slices and without time changes nothing and is none.
  FrameCounts finish(std::uint64_t stamp_us, const work::Crew& crew = work::Crew()) {
    decide(stamp_us, crew);
    return end_frame(crew);
  }
  // The two steps of it, steps 1 to 3 and step 5. Between them it is asked what follows, and named.
  // Core 0 may do something else beside either, once: do_beside(), which may read hits() beside the
  // first and names beside the second.
  void decide(std::uint64_t stamp_us, const work::Crew& crew) {
    decide(stamp_us, crew, [] {});
  }
  template <typename DoBeside>
  void decide(std::uint64_t stamp_us, const work::Crew& crew, DoBeside do_beside) {
    if (is_frame(stamp_us)) {
      decide_frame(stamp_us, crew, work::beside_of(do_beside));
    } else {
      do_beside();
    }
  }
  FrameCounts end_frame(const work::Crew& crew) {
    return end_frame(crew, [] {});
  }
  template <typename DoBeside>
  FrameCounts end_frame(const work::Crew& crew, DoBeside do_beside) {
    if (counts_.slices > 0) {
      ++fused_frames_;
      ground_.end_frame(window_, evidence_, {fused_frames_, newest_us_}, crew,
                        work::beside_of(do_beside));
    } else {
      do_beside();
    }
    hits_.clear();
    return std::exchange(counts_, {});
  }
  // Of the frame so far.
  [[nodiscard]] const FrameCounts& counts() const { return counts_; }

  // The hits of the frame, if it is followed, and how many had no room.
  [[nodiscard]] std::span<const placing::Hit> hits() const { return hits_.all(); }
  [[nodiscard]] std::uint32_t hits_left() const { return hits_.left(); }
  // As MovingNames, of a window that is followed.
  void name_moving(geometry::Cell cell, std::uint8_t sureness) {
    names_.give(cell, sureness, window_);
  }
  template <typename Held>
  void withdraw_moving(Held&& held) {
    names_.withdraw(evidence_, window_, held);
  }

  // What the map rules out in the tile at a slot: see Window. Names alone follow, and at once.
  void rule_out(std::size_t slot, const window::TileRuledOut& ruled_out) {
    window_.rule_out(slot, ruled_out);
    note_names(slot);
  }

  // Whether finish() makes a frame of what was added: it has a slice, or time has passed.
  [[nodiscard]] bool is_frame(std::uint64_t stamp_us) const {
    return counts_.slices > 0 || stamp_us > newest_us_;
  }

  // Nothing is known of any cell, and nothing said in this frame. Time goes on.
  void forget();

  // After finish(), until slices are added again.
  [[nodiscard]] window::WindowView view() const { return {window_, refreshed_, clock_}; }

  template <typename Visit>
  void for_each_guard(Visit&& visit) {
    visit(behind_evidence_);
    visit(behind_window_);
    visit(behind_counts_);
  }
  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, rules_, is_followed_);
  }

 private:
  // Of several cores: the least and the most tiles that one of them has together. What changes in
  // place is kept before, so the most say how large that is.
  static constexpr work::Runs::Lengths kFound{.shortest = 8, .longest = 32};
  static constexpr work::Runs::Lengths kUpdated{.shortest = 2, .longest = 6};

  // The tiles of a run before a frame changed them, as far as the run has come.
  struct TilesBefore {
    std::size_t begun = 0;
    std::array<TileBefore, kUpdated.longest> tiles{};

    // The next tile is about to be changed.
    TileBefore& begin(bool is_known) {
      TileBefore& next = tiles[begun];
      next.begin(is_known);
      work::keep_order();
      ++begun;
      work::keep_order();
      return next;
    }
  };

  // Groups of the tile at a slot, in this frame.
  struct SlotCounts {
    // Counted where evidence might not fit: of a slot without hits only if several cores fuse.
    GroupBudget groups;
    Budget allowed;  // so many may be fused then
    std::uint8_t fused = 0;
    std::uint8_t left = 0;
    std::uint8_t refreshed = 0;
    StandingCounts standing{};
  };
  static_assert(window::kGroupsPerTile <= 0xFF);

  // Slots in rising order.
  struct SlotList {
    std::size_t count = 0;
    std::array<std::uint16_t, window::kSlotCount> slots{};

    void add(std::size_t slot) { slots[count++] = static_cast<std::uint16_t>(slot); }
    [[nodiscard]] std::span<const std::uint16_t> all() const {
      return std::span(slots).first(count);
    }
    [[nodiscard]] std::span<const std::uint16_t> of(work::Run run) const {
      return std::span(slots).subspan(run.first, run.end - run.first);
    }
  };

  void decide_frame(std::uint64_t stamp_us, const work::Crew& crew, work::Beside beside);
  void find_arrivals(const work::Crew& crew);
  void look_at(std::size_t slot);
  void leave_out_high(std::size_t slot);
  void count_groups(const work::Crew& crew);
  [[nodiscard]] Budget budget() const;
  void update_tiles(const work::Crew& crew, work::Beside beside);
  void deal_out(Budget budget);
  void put_back(work::Run run, const TilesBefore& before);
  void put_back(std::size_t slot, const TileBefore& before);
  // With a TileBefore whoever may have to do it again puts everything back.
  template <typename... Before>
  void update_tile(const TileUpdate& update, std::size_t slot, Budget& budget, Before&... before);
  template <typename... Before>
  void fuse_tile(const TileUpdate& update, std::size_t slot, Budget& budget, Before&... before);
  [[nodiscard]] bool is_turn_to_refresh(std::size_t slot) const {
    return (slot + frames_) % kRefreshFrames == 0;
  }
  window::Tile& open(std::size_t slot);
  void add_up();
  void note_names(std::size_t slot) {
    if (is_followed_ && window_.is_known(slot)) {
      names_.note_tile(slot, window_.tile(slot));
    }
  }

  // What is aligned to a cache line comes first.
  work::BeforeImages<TilesBefore> tiles_before_;
  GroundMemory ground_;
  placing::FrameEvidence evidence_;
  health::Guard behind_evidence_;
  window::Window window_;
  health::Guard behind_window_;
  placing::HitList hits_;
  MovingNames names_;
  Rules rules_;
  bool is_followed_;
  ageing::Clock clock_;
  std::uint32_t frames_ = 0;
  std::uint32_t fused_frames_ = 0;
  std::uint64_t newest_us_ = 0;
  FrameCounts counts_{};
  window::Refreshed refreshed_{};
  Arrivals arrivals_;
  Opening opening_;
  SlotList due_;  // slots that this step is about
  std::array<SlotCounts, window::kSlotCount> slot_counts_{};
  health::Guard behind_counts_;
};
inline constexpr std::size_t kWindowBytes = sizeof(WindowFusion);
static_assert(geometry::kCellsPerSide > 1024 || kWindowBytes <= 17'600'000);

}  // namespace iog::perception
