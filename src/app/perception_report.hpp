// What a frame says of its place: which slices it had, where they were measured, and why others
// have no place.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "map/delivery.hpp"
#include "map/layer_report.hpp"
#include "objects/tracker.hpp"
#include "pose/fate.hpp"
#include "pose/history.hpp"
#include "pose/pose.hpp"
#include "pose/slice.hpp"
#include "stream/class_end.hpp"
#include "window/window_fusion.hpp"

namespace iog::app {

// Slices of one frame that are placed. 32 of 8 ms are more than twice the turn of a VLP-16.
inline constexpr std::size_t kMaxSlices = stream::kMaxSlices;

struct PlacedSlice {
  pose::Slice slice{};
  pose::Pose pose{};  // of its middle
  pose::Sigma sigma{};
  friend bool operator==(const PlacedSlice&, const PlacedSlice&) = default;
};

struct PerceptionReport {
  std::uint32_t number = 0;  // that of the frame
  // The frame's end on the clock of the poses: that of its last slice, or the newest pose if it has
  // no packets. It goes on from frame to frame also where that clock begins anew or is not known.
  std::uint64_t stamp_us = 0;
  bool is_forgotten = false;  // what was known before the frame has lost its place
  // Bit by pose::Cause: since the frame before it has begun, or kept a slice from its place.
  std::uint8_t causes = 0;

  // Where the vehicle was when the last slice that is placed ended, or without one at the stamp.
  pose::Placed end{};

  std::uint8_t log2_slice_ms = 0;  // how long a slice is
  std::size_t slice_count = 0;
  std::array<PlacedSlice, kMaxSlices> slices{};  // in the order of their times
  std::uint32_t slices_over_budget = 0;          // of this frame: they had poses, but no room
  std::uint32_t packets_placed = 0;              // of this frame
  std::uint32_t packets_not_placed = 0;
  window::FrameCounts window{};  // of this frame
  // Things with a speed. When they were where they are, by the clock of the poses; 0: nothing is
  // known of them.
  std::uint64_t objects_us = 0;
  objects::FrameCounts objects{};  // of this frame
  map::LayerReport map{};          // of this frame, but for what counts since start

  std::array<std::uint32_t, pose::kFateCount> pose_fates{};     // messages, since start
  std::array<std::uint32_t, pose::kCauseCount> slice_causes{};  // slices, since start
  std::array<pose::Tally, pose::kCauseCount> tallies{};         // how often each cause began

  const map::Block* map_block = nullptr;  // in use; valid until the next frame is finished
  map::DeliveryReport map_delivery{};
};

}  // namespace iog::app
