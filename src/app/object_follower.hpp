// Things with a speed on the perception grid: the hits and names of a frame go to the tracker, and
// what it says of names goes back (docs/objects.md).
#pragma once

#include <cstdint>
#include <span>

#include "fusion/frame_slices.hpp"
#include "objects/tracker.hpp"
#include "perception/window_fusion.hpp"
#include "pose/pose.hpp"
#include "work/crew.hpp"

namespace iog::app {

// Holds 2 MB: belongs into static memory.
class ObjectFollower {
 public:
  // A frame whose slices were added. end_us: the middle of its last slice by the clock of the
  // poses; slices: those that were placed, of which there is one at least; car: its place then.
  void begin(std::uint64_t end_us, std::span<const fusion::PlacedSlice> slices,
             const pose::Pose& car, const perception::WindowFusion& window);
  // Its classes are decided: what the hits are called, by all cores of the crew.
  void look_at_hits(const perception::WindowFusion& window, const work::Crew& crew);
  // It has not ended. Gives names; what is asked of the window before are names alone.
  objects::FrameCounts follow(perception::WindowFusion& window);

  // A frame without slices, that ends then.
  void pass(std::uint64_t end_us, perception::WindowFusion& window);

  // The window has lost its place.
  void forget() {
    tracker_.forget();
    is_begun_ = false;
  }

  [[nodiscard]] const objects::Tracker& tracker() const { return tracker_; }

 private:
  void name(perception::WindowFusion& window) const;

  objects::Tracker tracker_;
  bool is_begun_ = false;  // the frame changes something
};

}  // namespace iog::app
