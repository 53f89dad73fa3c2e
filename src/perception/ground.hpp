// What is remembered of the ground after a frame, from what was found in it.
//
// Beside what stands (3 by 3) nothing is remembered. Elsewhere a cell becomes dense if all 5 by 5
// are seen, and open if all 7 by 7 are shut. Shut is what is freed, with gaps of up to four cells
// between beams closed (dilated by 5 by 5, then eroded by 5 by 5), and not taken. What is found
// open again in another period of 480 ms is known better: ticks, at most 3. No cell outside of the
// window is shut; only what is dilated reaches there.
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

// Remembers the tile at a slot, of which something is known. `is_new_period`: a period has begun
// since the slot's turn before.
void remember(window::Window& window, std::size_t slot, bool is_new_period);

// Ground is found open again if a period has begun since the turn before of the tile's slot.
inline constexpr std::uint64_t kPeriodUs = 480'000;

// Which tiles remember their ground when a frame ends: those of which slot and number of fused
// frames are even in sum.
class GroundMemory {
 public:
  // No turn was ever.
  void forget() { last_turns_ = {}; }

  // A frame in which a slice was placed ends: its number among those, itself included, and when.
  // Then nothing is left of its evidence.
  struct Frame {
    std::uint32_t number = 0;
    std::uint64_t time_us = 0;
  };
  void end_frame(window::Window& window, placing::FrameEvidence& evidence, const Frame& frame,
                 const work::Crew& crew, work::Beside beside);

 private:
  // Of several cores: the least and the most tiles that one of them has together.
  static constexpr work::Runs::Lengths kEnded{.shortest = 8, .longest = 32};
  using Before = std::array<window::Ground, kEnded.longest>;

  void keep_before(window::Window& window, work::Run run, std::size_t item, std::size_t core);

  work::BeforeImages<Before> before_;
  // In which period the slots of either parity had their last turn.
  std::array<std::optional<std::uint64_t>, 2> last_turns_{};
};

}  // namespace iog::perception
