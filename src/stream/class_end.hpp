// The class end message of a frame (docs/spec.md 3.10). The message contains the CRC of the class
// grid, the outcomes of slices and pose messages, and the pose of each slice placed in the window.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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
  std::uint64_t middle_us = 0;  // middle of the slice, by the pose source's clock
  pose::Pose pose{};            // at middle_us
  pose::Sigma sigma{};
  friend constexpr bool operator==(const SliceRecord&, const SliceRecord&) = default;
};

// Counts how many slices a cause has kept out of the window since start.
struct CauseRecord {
  std::uint32_t slices = 0;  // for the cause kNone, the number of slices placed
  pose::Tally began{};       // how often the cause began, and the last time at which it began
};

struct ClassEnd {
  ClassWindow window{};
  std::uint32_t tiles_sent = 0;
  std::uint32_t tiles_lost = 0;   // known tiles not sent because the network accepted no message
  std::uint32_t classes_crc = 0;  // CRC of all tiles with a classified cell, even if not sent

  // The following values describe this frame.
  std::uint32_t packets_placed = 0;
  std::uint32_t packets_not_placed = 0;
  std::uint32_t slices_over_budget = 0;  // slices with a pose for which the window had no room
  std::uint32_t groups_fused = 0;
  std::uint32_t groups_left = 0;                 // groups with evidence left out because of the
                                                 // budget
  std::uint32_t groups_refreshed = 0;            // groups updated without evidence
  std::uint8_t slice_count = 0;                  // at most kMaxSlices
  std::array<SliceRecord, kMaxSlices> slices{};  // in chronological order

  std::array<std::uint32_t, pose::kFateCount>
      pose_fates{};  // numbers of pose messages by outcome, since start
  std::array<CauseRecord, pose::kCauseCount> causes{};
  MapState map{};
};

// Returns the number of bytes written, or 0 if the buffer is too small.
std::size_t write_class_end(const ClassEnd& end, std::span<std::byte> buffer);

// Returns kOk, kTooShort or kInconsistent. `kInconsistent` means that the records are shorter than
// expected. Skips fields that a later version may append.
[[nodiscard]] ReadStatus read_class_end(std::span<const std::byte> body, ClassEnd& end);

}  // namespace iog::stream
