// The window in time: slices of frames in, masses and classes out.
//
// In a frame the window follows the vehicle, slices are added, and the frame is finished:
//   1. what is asked of neighbours is answered from the state before the frame;
//   2. groups with evidence age, take it in, and are decided;
//   3. the tiles of which slot and number of frames are a multiple of 8 in sum are refreshed: its
//   other groups age and are decided without evidence;
//   4. if a slice was placed, the frame counts as fused, and the tiles of which slot and number of
//      fused frames, this one included, are even in sum remember their ground.
// Nothing depends on the order of slices or tiles.
//
// A frame has a budget of groups. Those with hits are always fused; of the others those beyond the
// budget are left, in the order of slots and numbers, and age.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "ageing/clock.hpp"
#include "ageing/discounting.hpp"
#include "ageing/gains.hpp"
#include "evidence/assignment.hpp"
#include "pose/pose.hpp"
#include "window/arrivals.hpp"
#include "window/frame_evidence.hpp"
#include "window/placement.hpp"
#include "window/slice_cells.hpp"
#include "window/tile_update.hpp"
#include "window/window.hpp"
#include "window/window_view.hpp"

namespace iog::window {

// Which hits on free ground are on something that moves.
enum class Moved : std::uint8_t {
  kOpenGround,  // window/arrivals.hpp
  kLiteral,     // all of them (Kurdej 2015, section 5.2), for comparison
};

struct Rules {
  ageing::Discounting discounting = ageing::Discounting::kConservative;
  ageing::Weighing weighing = ageing::Weighing::kByTime;
  // Masses by index; without it all hits have one mass. It outlives the fusion.
  const evidence::Assignment* assignment = nullptr;
  Moved moved = Moved::kOpenGround;
  // Groups fused in a frame. As many as a frame has marks at most, so that hits fit.
  std::uint32_t group_budget = 65'536;
};

// Every tile is refreshed once in so many frames.
inline constexpr std::uint32_t kRefreshFrames = 8;

// Ground is found open again if a period has begun since the turn before of the tile's slot.
inline constexpr std::uint64_t kPeriodUs = 480'000;

struct FrameCounts {
  std::uint32_t slices = 0;          // placed
  std::uint32_t slices_outside = 0;  // not placed: the vehicle is not in the window
  std::uint32_t groups_fused = 0;
  std::uint32_t groups_left = 0;       // they had evidence, but were over budget
  std::uint32_t groups_refreshed = 0;  // without evidence
  friend bool operator==(const FrameCounts&, const FrameCounts&) = default;
};

class WindowFusion {
 public:
  // Not constexpr: in static memory it is set up at start-up, not carried by the image.
  explicit WindowFusion(const Rules& rules = {});
  WindowFusion(const WindowFusion&) = delete;
  WindowFusion& operator=(const WindowFusion&) = delete;

  // Once a frame, before its first slice: the window follows the vehicle. Before the first time,
  // and after forget(), slices are outside.
  void follow(const pose::Pose& pose);

  // Adds the index grid of a slice, which is read like a grid::FrameView.
  template <typename View>
  void add(const View& slice, const Placement& at) {
    if (!window_.is_centred() || !window_.area().contains(cell_of(at.pose))) {
      ++counts_.slices_outside;
      return;
    }
    cells_.take(slice);
    evidence_.add(cells_, window_.area(), at);
    cells_.clear();
    ++counts_.slices;
  }

  // Ends a frame, whether slices were placed or not. A stamp that is older than the newest counts
  // as the newest.
  FrameCounts finish(std::uint64_t stamp_us);

  // Nothing is known of any cell, and nothing said in this frame. Time goes on.
  void forget();

  // After finish(), until the next slice.
  [[nodiscard]] WindowView view() const { return {window_, refreshed_, clock_}; }

 private:
  // How many groups without hits can be fused, or more than there are.
  [[nodiscard]] std::uint32_t budget_without_hits() const;
  void fuse_tile(const TileUpdate& update, std::size_t slot, std::uint32_t& budget);
  void refresh_tile(const TileUpdate& update, std::size_t slot);
  Tile& open(std::size_t slot);
  void remember_tiles();

  Rules rules_;
  ageing::Clock clock_;
  std::uint32_t frames_ = 0;
  std::uint32_t fused_frames_ = 0;
  std::uint64_t newest_us_ = 0;
  // In which period the slots of either parity had their last turn.
  std::array<std::optional<std::uint64_t>, 2> last_turns_{};
  FrameCounts counts_{};
  Refreshed refreshed_{};
  SliceCells cells_;
  FrameEvidence evidence_;
  Arrivals arrivals_;
  Window window_;
};
inline constexpr std::size_t kWindowBytes = sizeof(WindowFusion);
static_assert(geometry::kCellsPerSide > 1024 || kWindowBytes <= 17'000'000);

}  // namespace iog::window
