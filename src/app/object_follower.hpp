// Tracks objects on the perception grid. This class passes the hits and class labels of a frame to
// the tracker, and applies the tracker's labels to the grid (docs/objects.md).
#pragma once

#include <cstdint>
#include <span>

#include "fusion/frame_slices.hpp"
#include "objects/tracker.hpp"
#include "perception/window_fusion.hpp"
#include "pose/pose.hpp"
#include "work/crew.hpp"

namespace iog::app {

// An ObjectFollower uses 2 MB, so it must be in static memory.
class ObjectFollower {
 public:
  // Begins a frame whose slices have been added to the window. `end_us` is a time on the clock of
  // the poses, in the middle of the frame's last slice. `slices` contains at least one registered
  // slice. `car` is the vehicle's pose at end_us.
  void begin(std::uint64_t end_us, std::span<const fusion::PlacedSlice> slices,
             const pose::Pose& car, const perception::WindowFusion& window);
  // Reads the labels of the frame's hits, and lets tracks claim the hits. The cores of the crew
  // share this work. Call this function after the classes have been computed.
  void look_at_hits(const perception::WindowFusion& window, const work::Crew& crew);
  // Updates the tracks and labels the cells of moving objects. Call this function before the end of
  // the frame. The function uses only the window's labels, and reads all labels before changing any
  // of them.
  objects::FrameCounts follow(perception::WindowFusion& window);
  // Stores the hits for later frames. Call this function after follow().
  void remember_hits() {
    if (is_begun_) {
      tracker_.remember_hits();
    }
  }

  // Handles a frame without slices. `end_us` is half a slice before the end of the frame.
  void pass(std::uint64_t end_us, perception::WindowFusion& window);

  // Call this function when the window has been reset to unknown.
  void forget() {
    tracker_.forget();
    is_begun_ = false;
  }

  [[nodiscard]] const objects::Tracker& tracker() const { return tracker_; }

 private:
  void name(perception::WindowFusion& window) const;

  objects::Tracker tracker_;
  bool is_begun_ = false;  // the current frame changes the tracks
};

}  // namespace iog::app
