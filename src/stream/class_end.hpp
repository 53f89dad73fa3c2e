// The message that ends a frame's classes (docs/spec.md 3.10). It names the class grid, counts the
// outcomes of slices and pose messages, and lists the poses of the placed slices.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "pose/fate.hpp"
#include "pose/history.hpp"
#include "pose/message.hpp"
#include "pose/pose.hpp"
#include "stream/class_window.hpp"
#include "stream/map_state.hpp"
#include "stream/message.hpp"

namespace iog::stream {

inline constexpr std::size_t kMaxSlices = 32;

// A slice placed in the window.
struct SliceRecord {
  std::uint64_t middle_us = 0;  // by the clock of the pose source
  pose::Pose pose{};            // at middle_us
  pose::Sigma sigma{};
  friend constexpr bool operator==(const SliceRecord&, const SliceRecord&) = default;
};

// Slices that one cause has kept from being placed, since start.
struct CauseRecord {
  std::uint32_t slices = 0;  // for the cause kNone: slices that were placed
  pose::Tally began{};       // how often the cause began, and when it last did
};

struct ClassEnd {
  ClassWindow window{};
  std::uint32_t tiles_sent = 0;
  std::uint32_t tiles_lost = 0;   // known but not sent: the network accepted no message
  std::uint32_t classes_crc = 0;  // of all tiles with a classified cell, sent or not

  // In this frame.
  std::uint32_t packets_placed = 0;
  std::uint32_t packets_not_placed = 0;
  std::uint32_t slices_over_budget = 0;  // had a pose, but the window had no room
  std::uint32_t groups_fused = 0;
  std::uint32_t groups_left = 0;                 // had evidence, but exceeded the budget
  std::uint32_t groups_refreshed = 0;            // without evidence
  std::uint8_t slice_count = 0;                  // at most kMaxSlices
  std::array<SliceRecord, kMaxSlices> slices{};  // in order of time

  std::array<std::uint32_t, pose::kFateCount>
      pose_fates{};  // pose messages by outcome, since start
  std::array<CauseRecord, pose::kCauseCount> causes{};
  std::optional<MapState> map{};  // empty if the target sends no map state
};

// Returns the number of bytes written, or 0 if the buffer is too small.
std::size_t write_class_end(const ClassEnd& end, std::span<std::byte> buffer);

// Returns kOk, kTooShort, or kInconsistent if records are shorter than ours. Skips entries that a
// later version appends.
[[nodiscard]] ReadStatus read_class_end(std::span<const std::byte> body, ClassEnd& end);

}  // namespace iog::stream
