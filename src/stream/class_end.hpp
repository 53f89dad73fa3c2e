// The message that ends a frame's classes (docs/spec.md 3.10): the name of their grid, what became
// of slices and of pose messages, and by which poses the slices were placed.
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

// A slice that was placed.
struct SliceRecord {
  std::uint64_t middle_us = 0;  // by the clock of the pose source
  pose::Pose pose{};            // at that time
  pose::Sigma sigma{};
  friend constexpr bool operator==(const SliceRecord&, const SliceRecord&) = default;
};

// Why slices had no place, since start.
struct CauseRecord {
  std::uint32_t slices = 0;  // of cause kNone: those that had a place
  pose::Tally began{};       // how often it began, and when it did last
};

struct ClassEnd {
  ClassWindow window{};
  std::uint32_t tiles_sent = 0;
  std::uint32_t tiles_lost = 0;   // known, but the network took no message
  std::uint32_t classes_crc = 0;  // of all tiles in which a cell has a class, sent or not

  // Of this frame.
  std::uint32_t packets_placed = 0;
  std::uint32_t packets_not_placed = 0;
  std::uint32_t slices_over_budget = 0;  // they had poses, but no room
  std::uint32_t groups_fused = 0;
  std::uint32_t groups_left = 0;                 // they had evidence, but were over budget
  std::uint32_t groups_refreshed = 0;            // without evidence
  std::uint8_t slice_count = 0;                  // at most kMaxSlices
  std::array<SliceRecord, kMaxSlices> slices{};  // in the order of their times

  std::array<std::uint32_t, pose::kFateCount> pose_fates{};  // messages by fate, since start
  std::array<CauseRecord, pose::kCauseCount> causes{};
  std::optional<MapState> map{};  // empty: the target knows nothing of maps
};

// Returns the bytes written, 0 if the buffer is too small.
std::size_t write_class_end(const ClassEnd& end, std::span<std::byte> buffer);

// kOk, kTooShort, or kInconsistent where records are shorter than ours. Entries of a later version
// beyond ours are skipped.
[[nodiscard]] ReadStatus read_class_end(std::span<const std::byte> body, ClassEnd& end);

}  // namespace iog::stream
