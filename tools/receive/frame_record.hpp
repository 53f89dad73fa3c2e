// A frame in one line of text, by which two runs on the same packets are compared.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "stream/crc32.hpp"
#include "tools/frames/grid_frame.hpp"

namespace iog::tools {

// Only frames with evidence have one.
struct FrameRecord {
  std::uint64_t number = 0;  // GridFrame::evidence_number
  std::uint8_t complete_sensors = 0;
  std::uint8_t partial_sensors = 0;
  std::vector<std::uint16_t> packets{};  // by sensor; none if the frame's end was lost
  std::uint32_t points_used = 0;
  std::uint32_t tiles = 0;
  std::uint32_t grid_crc = 0;
  // Not in the line: facts of the run, not of the packets.
  bool is_timed_out = false;
  bool is_too_slow = false;  // the target has left points that it had no time for

  // The same packets took part, if they did in all frames before, as each sensor's come in their
  // order. Points alone do not say so: there are packets none of whose points is used.
  [[nodiscard]] bool has_same_participation(const FrameRecord& other) const {
    return complete_sensors == other.complete_sensors && partial_sensors == other.partial_sensors &&
           points_used == other.points_used &&
           (packets == other.packets || packets.empty() || other.packets.empty());
  }
  [[nodiscard]] bool has_same_grid(const FrameRecord& other) const {
    return tiles == other.tiles && grid_crc == other.grid_crc;
  }
};

[[nodiscard]] FrameRecord record_of(const GridFrame& frame);

// Scan points that the target has left in this frame, because it is too slow for its sensors.
[[nodiscard]] std::uint32_t points_not_taken(const stream::FrameEnd& end);

// "17 f 0 6,6,6,6 2871 433 9ac01b22"; where its packets are not known "-" stands for them.
[[nodiscard]] std::string line_of(const FrameRecord& record);

// Reads a file that --hashes has written. UsageError if it is another kind of file.
[[nodiscard]] std::vector<FrameRecord> read_records(const std::string& path);
void write_records(const std::string& path, const std::vector<FrameRecord>& records);

// The name of a whole run: CRC-32 over the names of the grids of its frames with evidence, each
// four bytes, big endian.
class RunHash {
 public:
  void add(std::uint32_t grid_crc);
  [[nodiscard]] std::uint32_t value() const { return crc_.value(); }

 private:
  stream::Crc32 crc_;
};

// Compares two runs. Nothing if they are equal; otherwise one sentence on the first difference.
[[nodiscard]] std::optional<std::string> first_difference(const std::vector<FrameRecord>& received,
                                                          const std::vector<FrameRecord>& expected);

}  // namespace iog::tools
