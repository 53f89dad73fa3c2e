// What the objects of a run amount to: sums over its frames, and their part of the table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <set>
#include <string>

#include "tools/frames/grid_frame.hpp"
#include "tools/program/table.hpp"
#include "tools/receive/frame_record.hpp"

namespace iog::tools {

class ObjectStatistics {
 public:
  // Frames in their order; those whose target looks for no objects change nothing.
  void add(const GridFrame& frame);

  [[nodiscard]] std::uint64_t incomplete() const { return incomplete_; }
  // The CRC-32 of the names of all lists of frames with evidence, as the name of a run.
  [[nodiscard]] std::uint32_t run_hash() const { return hash_.value(); }
  // How many there were, over all frames.
  [[nodiscard]] std::uint64_t objects() const {
    return std::accumulate(by_state_.begin(), by_state_.end(), std::uint64_t{0});
  }

  // As RunStatistics has them.
  [[nodiscard]] Facts facts() const;
  // Empty if no frame had objects.
  [[nodiscard]] std::string table() const;

 private:
  std::uint64_t frames_ = 0;
  std::uint64_t incomplete_ = 0;             // a part of the list is missing
  std::uint64_t not_known_ = 0;              // the frame had no place
  std::array<std::uint64_t, 4> by_state_{};  // young, stands, moves, stopped: sums over the frames
  std::size_t most_moving_ = 0;              // in a frame
  std::set<std::uint32_t> moved_;            // ids
  std::uint64_t tracks_refused_ = 0;
  std::uint64_t hits_left_ = 0;
  RunHash hash_;
};

// The name of a list: CRC-32 over its time, u64, and its objects as docs/spec.md 3.12 has them, all
// big endian; 0 without objects.
[[nodiscard]] std::uint32_t crc_of(const stream::ObjectList& list);

}  // namespace iog::tools
