// Updates the ground memory after a frame.
//
// The update clears the memory of all cells in the 3 by 3 square around each standing cell. Any
// other cell becomes dense if all cells in the 5 by 5 square around it have been seen, and open if
// all cells in the 7 by 7 square around it are free. Free space is computed from the freed cells in
// two steps. First, a 5 by 5 dilation followed by a 5 by 5 erosion closes gaps of up to four cells
// between beams. Then occupied cells are removed. Each cell also has a counter from 0 to 3. The
// first update in each new period of 480 ms increments the counters of all cells that are found
// open. Cells outside the window never count as free space, even though the dilation extends beyond
// the window.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "perception/rules.hpp"
#include "placing/frame_evidence.hpp"
#include "window/window.hpp"
#include "work/before_images.hpp"
#include "work/crew.hpp"
#include "work/runs.hpp"

namespace iog::perception {

// Updates the ground memory of a known tile. `is_new_period` is true if a new period has begun
// since the slot was last updated.
void remember(window::Window& window, std::size_t slot, bool is_new_period,
              const Around& around = {});

// The length of a period. The counter of a cell is incremented at most once per period.
inline constexpr std::uint64_t kPeriodUs = 480'000;

// Updates half of the tiles at the end of a frame. A tile is updated if the sum of its slot and the
// number of fused frames is even.
class GroundMemory {
 public:
  explicit GroundMemory(const Around& around) : around_(around) {}

  // Clears the stored periods of the previous updates.
  void forget() { last_turns_ = {}; }

  // Ends a frame with at least one registered slice, and clears the frame's evidence. `number` is
  // the count of such frames so far, including this one.
  struct Frame {
    std::uint32_t number = 0;
    std::uint64_t time_us = 0;
  };
  void end_frame(window::Window& window, placing::FrameEvidence& evidence, const Frame& frame,
                 const work::Crew& crew, work::Beside beside);

 private:
  // The minimum and maximum number of tiles that one core claims at a time when several cores share
  // the work.
  static constexpr work::Runs::Lengths kEnded{.shortest = 8, .longest = 32};
  using Before = std::array<window::Ground, kEnded.longest>;

  void keep_before(window::Window& window, work::Run run, std::size_t item, std::size_t core);

  work::BeforeImages<Before> before_;
  Around around_;
  // The period of the previous update, stored separately for even and odd slots.
  std::array<std::optional<std::uint64_t>, 2> last_turns_{};
};

}  // namespace iog::perception
