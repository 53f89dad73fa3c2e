// The classes of a frame in one line of text, by which two runs on the same packets are compared.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/frames/grid_frame.hpp"

namespace iog::tools {

// Only frames with evidence and classes have one.
struct ClassRecord {
  std::uint64_t number = 0;    // GridFrame::evidence_number
  std::uint64_t stamp_us = 0;  // by the clock of the poses
  std::uint32_t slices = 0;    // placed
  std::uint32_t packets_placed = 0;
  std::uint32_t packets_not_placed = 0;
  std::uint16_t causes = 0;  // bits of stream::ClassWindow::causes: a fact of the run
  std::int32_t corner_a = 0;
  std::int32_t corner_b = 0;
  std::uint32_t tiles = 0;
  std::uint32_t class_crc = 0;
  // Frames without evidence in which the window's time went on, since the first record of the run.
  std::uint32_t frames_of_time = 0;
  // Pose messages that were used until then, since start: as many poses could place the slices.
  std::uint32_t poses_used = 0;
  // The pose of each slice that was placed, by a CRC; none if the end of the classes was lost.
  std::vector<std::uint32_t> slice_poses{};

  // The same packets were placed at the same time. The stamp of a frame in which none was is of the
  // target's clock.
  [[nodiscard]] bool has_same_place(const ClassRecord& other) const {
    return slices == other.slices && packets_placed == other.packets_placed &&
           packets_not_placed == other.packets_not_placed &&
           (slices == 0 || stamp_us == other.stamp_us);
  }
  // Where both are known.
  [[nodiscard]] bool has_same_poses(const ClassRecord& other) const {
    return slice_poses == other.slice_poses || slice_poses.empty() || other.slice_poses.empty();
  }
  [[nodiscard]] bool has_same_classes(const ClassRecord& other) const {
    return corner_a == other.corner_a && corner_b == other.corner_b && tiles == other.tiles &&
           class_crc == other.class_crc;
  }
};

// frame.classes has a value.
[[nodiscard]] ClassRecord class_record_of(const GridFrame& frame, std::uint32_t frames_of_time);

// "17 1000680000 2 20 0 0 -16 -15 433 9ac01b22 0 70 0c1f2a3b,9ac01b22"; causes are hexadecimal, and
// where the slices' poses are not known "-" stands for them.
[[nodiscard]] std::string line_of(const ClassRecord& record);

// Reads a file that --classes-hashes has written. UsageError if it is another kind of file.
[[nodiscard]] std::vector<ClassRecord> read_class_records(const std::string& path);
void write_class_records(const std::string& path, const std::vector<ClassRecord>& records);

// As that of FrameRecords.
[[nodiscard]] std::optional<std::string> first_difference(const std::vector<ClassRecord>& received,
                                                          const std::vector<ClassRecord>& expected);

}  // namespace iog::tools
