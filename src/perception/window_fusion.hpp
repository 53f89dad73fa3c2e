// Fuses the slices of frames over time into masses and classes of the window.
//
// In each frame the window follows the vehicle, slices are added, and the frame is finished:
//   1. Lookups of neighbours use the state before the frame. Where only low beams open ground
//      (perception/opening.hpp), evidence that does not count is removed.
//   2. Groups with evidence are aged, fused and decided.
//   3. Tiles whose slot plus frame number is a multiple of 8 are refreshed: their other groups
//      are aged and decided without evidence. Frames count once the window has a place.
//   4. Tracking relabels moving cells (perception/moving_names.hpp).
//   5. If a slice was registered, the frame counts as fused. Tiles whose slot plus number of fused
//      frames, including this one, is even update their ground.
// The order of slices or tiles does not matter.
//
// Each step is a parallel loop over runs of tiles. Ageing, fusion and refresh of a tile are one
// step. No item of a step writes data that the step reads of neighbours.
//
// A frame has a budget of groups. Groups with hits come first, then the others, each in the order
// of slots and numbers. Groups over budget only age.
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

// Every tile is refreshed once in this many frames.
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
  // Not constexpr, so static objects are initialised at start-up and take no space in the image.
  // is_followed: objects are tracked. Then the hits of a frame are listed and cells can be
  // relabelled.
  explicit WindowFusion(const Rules& rules = {}, bool is_followed = false);
  WindowFusion(const WindowFusion&) = delete;
  WindowFusion& operator=(const WindowFusion&) = delete;

  // Moves the window with the vehicle. Call once per frame, before its first slice. Before the
  // first call, and after forget(), all slices are outside.
  void follow(const pose::Pose& pose);

  // Adds at most FrameEvidence::kMostAtOnce slices.
  void add(std::span<const placing::PlacedCells> slices, const work::Crew& crew = work::Crew());

  // Ends a frame, with or without registered slices. A stamp older than the newest one counts as
  // the newest. Has no effect if there are no slices and no time has passed.
  FrameCounts finish(std::uint64_t stamp_us, const work::Crew& crew = work::Crew()) {
    decide(stamp_us, crew);
    return end_frame(crew);
  }
  // The two parts of finish(): decide() does steps 1 to 3, end_frame() does step 5. Tracking and
  // relabelling run between them. Core 0 runs do_beside() once at the same time. It may read hits()
  // during decide(), and labels during end_frame().
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
  // Counts of the current frame so far.
  [[nodiscard]] const FrameCounts& counts() const { return counts_; }

  // The hits of the frame if objects are tracked, and the number of hits dropped for lack of room.
  [[nodiscard]] std::span<const placing::Hit> hits() const { return hits_.all(); }
  [[nodiscard]] std::uint32_t hits_left() const { return hits_.left(); }
  // See MovingNames. Only if objects are tracked.
  void name_moving(geometry::Cell cell, std::uint8_t sureness) {
    names_.give(cell, sureness, window_);
  }
  template <typename Held>
  void withdraw_moving(Held&& held) {
    names_.withdraw(evidence_, window_, held);
  }

  // Sets the classes that the map rules out in the tile at a slot; see Window. Only labels change,
  // and at once.
  void rule_out(std::size_t slot, const window::TileRuledOut& ruled_out) {
    window_.rule_out(slot, ruled_out);
    note_names(slot);
  }

  // Whether finish() would end a frame: there is a slice, or time has passed.
  [[nodiscard]] bool is_frame(std::uint64_t stamp_us) const {
    return counts_.slices > 0 || stamp_us > newest_us_;
  }

  // Forgets all cells and the current frame. Time goes on.
  void forget();

  // Valid after finish(), until slices are added again.
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
  // Fewest and most tiles that one core takes at once, if several cores share the work. The largest
  // number also sets the size of the undo log.
  static constexpr work::Runs::Lengths kFound{.shortest = 8, .longest = 32};
  static constexpr work::Runs::Lengths kUpdated{.shortest = 2, .longest = 6};

  // Undo log of a run of tiles. It covers the tiles that the run has reached.
  struct TilesBefore {
    std::size_t begun = 0;
    std::array<TileBefore, kUpdated.longest> tiles{};

    // Call before the next tile changes.
    TileBefore& begin(bool is_known) {
      TileBefore& next = tiles[begun];
      next.begin(is_known);
      work::keep_order();
      ++begun;
      work::keep_order();
      return next;
    }
  };

  // Counts of groups of the tile at a slot in this frame.
  struct SlotCounts {
    // Counted only if the evidence might exceed the budget. Slots without hits are counted only if
    // several cores fuse.
    GroupBudget groups;
    Budget allowed;  // groups that may be fused in that case
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
  // With a TileBefore, a core that repeats the work can restore the tile.
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
