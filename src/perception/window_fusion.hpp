// Fuses the slices of successive frames into the masses and classes of the window.
//
// In each frame, the window first follows the vehicle, and then slices are added. Finally, the
// frame is finished in five steps.
//   Step 1: Hits are compared with the cells around them, as they were before the frame. If only
//     low beams can free occupied cells (perception/opening.hpp), misses from other beams are
//     removed from these cells.
//   Step 2: Groups with evidence are aged, fused and classified.
//   Step 3: A tile is refreshed if its slot number plus the frame number is a multiple of 8. A
//     refresh ages and classifies the groups that were not fused. The frame number counts only
//     frames in which the window has a position.
//   Step 4: Tracking relabels moving cells (perception/moving_names.hpp).
//   Step 5: If a slice was registered, the frame counts as fused. The ground of a tile is updated
//     if the tile's slot number plus the number of fused frames, including this frame, is even.
// The result does not depend on the order of slices or tiles.
//
// Each step is a parallel loop over runs of tiles. A tile is aged, fused and refreshed in the same
// loop. Within a step, no item writes data that another item reads from a neighbouring tile.
//
// Each frame has a budget of groups. Groups with hits take precedence over other groups. Within
// each of these two kinds, groups are ordered by slot and group number. Groups that exceed the
// budget are aged as usual, but their evidence is discarded.
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

// Each tile is refreshed once every kRefreshFrames frames.
inline constexpr std::uint32_t kRefreshFrames = 8;

struct FrameCounts {
  std::uint32_t slices = 0;          // registered
  std::uint32_t slices_outside = 0;  // not registered, because the vehicle is outside the window
  std::uint32_t groups_fused = 0;
  std::uint32_t groups_left = 0;       // had evidence, but were over budget
  std::uint32_t groups_refreshed = 0;  // aged without evidence
  StandingCounts standing{};
  friend bool operator==(const FrameCounts&, const FrameCounts&) = default;
};

class WindowFusion {
 public:
  // The constructor is not constexpr. Static objects are therefore initialised at start-up and take
  // up no space in the image. `is_followed` is true if objects are tracked. In this case, the hits
  // of a frame are listed, and cells can be relabelled.
  explicit WindowFusion(const Rules& rules = {}, bool is_followed = false,
                        std::int32_t cell_mm = geometry::kCellMm);
  WindowFusion(const WindowFusion&) = delete;
  WindowFusion& operator=(const WindowFusion&) = delete;

  // Moves the window with the vehicle. Call follow() once per frame, before the frame's first
  // slice. Before the first call, and after forget(), all slices are outside the window.
  void follow(const pose::Pose& pose);

  // Adds at most FrameEvidence::kMostAtOnce slices.
  void add(std::span<const placing::PlacedCells> slices, const work::Crew& crew = work::Crew());

  // Ends a frame, with or without registered slices. If `stamp_us` is older than the newest
  // timestamp so far, that timestamp is used instead. The call has no effect if the frame has no
  // slices and no time has passed.
  FrameCounts finish(std::uint64_t stamp_us, const work::Crew& crew = work::Crew()) {
    decide(stamp_us, crew);
    return end_frame(crew);
  }
  // The two parts of finish(). `decide()` performs steps 1 to 3, and end_frame() performs step 5.
  // Tracking and relabelling run between decide() and end_frame(). While each part runs, core 0
  // calls do_beside() once. During decide(), do_beside() may read hits(). During end_frame(),
  // do_beside() may read labels.
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
  // Returns the counts of the current frame so far.
  [[nodiscard]] const FrameCounts& counts() const { return counts_; }

  // If objects are tracked, hits() returns the hits of the frame. `hits_left()` returns the number
  // of hits that were dropped because the list was full.
  [[nodiscard]] std::span<const placing::Hit> hits() const { return hits_.all(); }
  [[nodiscard]] std::uint32_t hits_left() const { return hits_.left(); }
  // See MovingNames. Call name_moving() and withdraw_moving() only if objects are tracked.
  void name_moving(geometry::Cell cell, std::uint8_t sureness) {
    names_.give(cell, sureness, window_);
  }
  template <typename Held>
  void withdraw_moving(Held&& held) {
    names_.withdraw(evidence_, window_, held);
  }

  // Records which classes the map rules out in a tile (see Window). The call changes only labels,
  // and takes effect immediately.
  void rule_out(std::size_t slot, const window::TileRuledOut& ruled_out) {
    window_.rule_out(slot, ruled_out);
    note_names(slot);
  }

  // Returns true if finish() would end a frame. A frame ends if it has a slice or if time has
  // passed.
  [[nodiscard]] bool is_frame(std::uint64_t stamp_us) const {
    return counts_.slices > 0 || stamp_us > newest_us_;
  }

  // Clears all cells and the current frame. The clock is not reset.
  void forget();

  [[nodiscard]] std::int32_t cell_mm() const { return cell_mm_; }

  // Returns a view of the window. After finish(), the view is valid until slices are added again.
  [[nodiscard]] window::WindowView view() const { return {window_, refreshed_, clock_}; }
  [[nodiscard]] std::int32_t blind_mm() const { return rules_.blind_mm; }

  template <typename Visit>
  void for_each_guard(Visit&& visit) {
    visit(behind_evidence_);
    visit(behind_window_);
    visit(behind_counts_);
  }
  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, rules_, is_followed_, cell_mm_);
  }

 private:
  // The minimum and maximum number of tiles that one core claims at a time when several cores share
  // the work. The maximum also determines the size of the undo log.
  static constexpr work::Runs::Lengths kFound{.shortest = 8, .longest = 32};
  static constexpr work::Runs::Lengths kUpdated{.shortest = 2, .longest = 6};

  // The undo log of a run of tiles. The log covers the tiles that the run has already reached.
  struct TilesBefore {
    std::size_t begun = 0;
    std::array<TileBefore, kUpdated.longest> tiles{};

    // Call begin() before changing the next tile.
    TileBefore& begin(bool is_known) {
      TileBefore& next = tiles[begun];
      next.begin(is_known);
      work::keep_order();
      ++begun;
      work::keep_order();
      return next;
    }
  };

  // The counts of a slot in the current frame.
  struct SlotCounts {
    // Groups are counted only if the evidence might exceed the budget. The groups of slots without
    // hits are counted only if several cores share the work.
    GroupBudget groups;
    Budget allowed;  // groups that may be fused in that case
    std::uint8_t fused = 0;
    std::uint8_t left = 0;
    std::uint8_t refreshed = 0;
    StandingCounts standing{};
  };
  static_assert(window::kGroupsPerTile <= 0xFF);

  // A list of slots in ascending order.
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
  // If a TileBefore is passed, it stores the state of the tile before the update, so that another
  // core can restore the tile and repeat the work.
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

  // Members that are aligned to a cache line come first.
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
  std::int32_t cell_mm_;
  ageing::Clock clock_;
  std::uint32_t frames_ = 0;
  std::uint32_t fused_frames_ = 0;
  std::uint64_t newest_us_ = 0;
  FrameCounts counts_{};
  window::Refreshed refreshed_{};
  Arrivals arrivals_;
  Opening opening_;
  SlotList due_;  // slots of the current step
  std::array<SlotCounts, window::kSlotCount> slot_counts_{};
  health::Guard behind_counts_;
};
inline constexpr std::size_t kWindowBytes = sizeof(WindowFusion);
static_assert(geometry::kCellsPerSide > 1024 || kWindowBytes <= 17'600'000);

}  // namespace iog::perception
