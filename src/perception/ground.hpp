// Updates what is remembered of the ground after a frame.
//
// Nothing is remembered in the 3 by 3 cells around a standing cell. Elsewhere a cell becomes dense
// if all 5 by 5 cells around it are seen, and open if all 7 by 7 are shut. Shut cells are the freed
// cells after gaps of up to four cells between beams are closed (dilation by 5 by 5, then erosion
// by 5 by 5), except occupied cells. A cell that is open again in a later period of 480 ms gets one
// more tick, at most 3. No cell outside the window is shut; only the dilation extends there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "placing/frame_evidence.hpp"
#include "window/window.hpp"
#include "work/before_images.hpp"
#include "work/crew.hpp"
#include "work/runs.hpp"

namespace iog::perception {

// Updates the ground of a known tile. `is_new_period`: a period has begun since the previous turn
// of the slot.
void remember(window::Window& window, std::size_t slot, bool is_new_period);

// Length of a period. Each period in which a cell is open again adds a tick.
inline constexpr std::uint64_t kPeriodUs = 480'000;

// Updates half of the tiles at the end of a frame: those whose slot plus the number of fused frames
// is even.
class GroundMemory {
 public:
  // Forgets all previous turns.
  void forget() { last_turns_ = {}; }

  // Ends a frame with a registered slice and clears its evidence. `number` counts such frames,
  // including this one.
  struct Frame {
    std::uint32_t number = 0;
    std::uint64_t time_us = 0;
  };
  void end_frame(window::Window& window, placing::FrameEvidence& evidence, const Frame& frame,
                 const work::Crew& crew, work::Beside beside);

 private:
  // Fewest and most tiles that one core takes at once, if several cores share the work.
  static constexpr work::Runs::Lengths kEnded{.shortest = 8, .longest = 32};
  using Before = std::array<window::Ground, kEnded.longest>;

  void keep_before(window::Window& window, work::Run run, std::size_t item, std::size_t core);

  work::BeforeImages<Before> before_;
  // Period of the previous turn, for even and odd slots.
  std::array<std::optional<std::uint64_t>, 2> last_turns_{};
};

}  // namespace iog::perception
