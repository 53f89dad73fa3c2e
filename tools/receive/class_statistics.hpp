// What the classes of a run amount to: sums over its frames, and their part of the table.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/frames/grid_frame.hpp"
#include "tools/program/table.hpp"
#include "tools/receive/class_record.hpp"
#include "tools/receive/frame_record.hpp"

namespace iog::tools {

class ClassStatistics {
 public:
  // Frames in their order; those without classes change nothing.
  void add(const GridFrame& frame);

  [[nodiscard]] const std::vector<ClassRecord>& records() const { return records_; }
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  [[nodiscard]] std::uint64_t incomplete() const { return incomplete_; }
  [[nodiscard]] std::uint64_t damaged() const { return damaged_; }
  [[nodiscard]] std::uint32_t run_hash() const { return hash_.value(); }

  // As RunStatistics has them.
  [[nodiscard]] Facts facts() const;
  // Why no slice had a place, if none had: "none of its 60 pose messages was used: 60 damaged".
  [[nodiscard]] std::string why_nothing_placed(std::uint16_t pose_port) const;
  // Empty if no frame had classes.
  [[nodiscard]] std::string table() const;

 private:
  std::uint16_t cell_mm_ = geometry::kCellMm;
  window::Extent extent_{};
  std::uint64_t frames_ = 0;
  std::uint64_t incomplete_ = 0;  // a message about classes is missing
  std::uint64_t damaged_ = 0;     // not the classes that the target says, though all have come
  std::uint64_t tiles_ = 0;
  std::uint64_t tiles_not_sent_ = 0;  // the target's network took no message
  std::uint64_t packets_placed_ = 0;
  std::uint64_t packets_not_placed_ = 0;
  std::uint64_t slices_over_budget_ = 0;
  std::uint64_t groups_left_ = 0;     // over budget
  std::uint64_t stamp_us_ = 0;        // of the last frame
  std::uint32_t frames_of_time_ = 0;  // ClassRecord::frames_of_time
  bool had_end_ = false;
  stream::ClassEnd last_;  // what counts since the target's start
  std::optional<std::uint32_t> run_number_;
  bool was_restarted_ = false;
  std::vector<ClassRecord> records_;
  RunHash hash_;
};

}  // namespace iog::tools
