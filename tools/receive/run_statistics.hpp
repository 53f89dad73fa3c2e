// What a run amounts to: sums over its frames, and the table at its end.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/thermometer.hpp"
#include "tools/frames/grid_frame.hpp"
#include "tools/program/table.hpp"
#include "tools/receive/class_statistics.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/receive/object_statistics.hpp"
#include "tools/report/counters.hpp"
#include "vehicle/beam.hpp"

namespace iog::tools {

// Mean and maximum of times in microseconds.
class TimeStatistics {
 public:
  void add(double micros);
  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] double mean() const { return count_ > 0 ? sum_ / static_cast<double>(count_) : 0; }
  [[nodiscard]] double max() const { return max_; }

 private:
  std::uint64_t count_ = 0;
  double sum_ = 0;
  double max_ = 0;
};

class RunStatistics {
 public:
  // Frames in their order.
  void add(const GridFrame& frame);

  [[nodiscard]] const std::vector<FrameRecord>& records() const { return records_; }
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  [[nodiscard]] std::uint64_t incomplete() const { return incomplete_; }
  [[nodiscard]] std::uint64_t damaged() const { return damaged_; }
  // Frames without evidence that scan points came for.
  [[nodiscard]] std::uint64_t nothing_taken() const { return nothing_taken_; }
  [[nodiscard]] std::uint64_t points_used() const;
  // Of each sensor.
  [[nodiscard]] const std::array<std::uint64_t, vehicle::kMaxSensors>& packets_fused() const {
    return packets_fused_;
  }
  [[nodiscard]] std::uint64_t packets_late() const {
    return packet_drops_[static_cast<std::size_t>(intake::PacketDrop::kLate)];
  }
  [[nodiscard]] std::uint32_t run_hash() const { return hash_.value(); }
  [[nodiscard]] const ClassStatistics& classes() const { return classes_; }
  [[nodiscard]] const ObjectStatistics& objects() const { return objects_; }

  [[nodiscard]] Facts facts() const;
  // The same for a person, aligned. has_target: with the rows that only a real target fills.
  [[nodiscard]] std::string table(bool has_target) const;

 private:
  void add_times(const GridFrame& frame);
  void add_drops(const GridFrame& frame);
  void add_states(const GridFrame& frame);
  void add_points(const stream::FrameEnd& end);
  void add_target_facts(Facts& facts) const;
  [[nodiscard]] std::string rows_of_sensors() const;
  [[nodiscard]] std::string rows_of_ground() const;
  [[nodiscard]] std::string row_of_too_slow() const;
  [[nodiscard]] std::string row_of_over_budget() const;
  [[nodiscard]] std::string rows_of_target() const;

  std::uint64_t frames_ = 0;
  std::uint64_t timed_out_ = 0;
  std::uint64_t incomplete_ = 0;  // a message of them is missing
  std::uint64_t damaged_ = 0;     // not the grid that the target says, though all has come
  std::uint64_t too_slow_ = 0;    // the target has left points that it had no time for
  std::uint64_t nothing_taken_ = 0;
  geometry::Grid grid_;  // of the newest frame with evidence
  std::uint64_t tiles_ = 0;
  std::uint64_t tiles_not_sent_ = 0;  // the target's network took no message
  std::array<std::uint64_t, vehicle::kFateCount> fates_{};
  std::array<std::uint32_t, intake::kPacketDropCount> packet_drops_{};
  std::array<std::uint32_t, intake::kPacketDropCount> drops_before_{};  // the target's last start
  TimeStatistics fuse_us_;
  TimeStatistics mark_us_;
  TimeStatistics perceive_us_;
  TimeStatistics publish_us_;
  TimeStatistics frame_us_;             // all of these together
  double until_published_us_ = 0;       // of the last frame: all but publishing
  std::optional<stream::Header> last_;  // of the last frame with an end
  std::uint32_t stack_used_bytes_ = 0;
  std::optional<hal::RunBefore> run_before_;
  std::optional<CommandCounts> commands_;
  std::optional<LoopTimes> loop_times_;
  std::int16_t hottest_dc_ = hal::kTemperatureNotKnown;  // of the chip
  std::optional<std::uint64_t> unwatched_;               // in both of the newest two frames
  std::uint64_t newest_unwatched_ = ~std::uint64_t{0};   // in the newest frame that counts
  std::uint64_t frames_without_scan_ = 0;                // in a row, up to the newest
  std::optional<std::uint64_t> blocked_;
  std::array<std::uint32_t, vehicle::kMaxSensors> blocked_frames_{};  // in some sectors or all
  std::optional<work::TeamCounts> core_shares_;                       // since the target's start
  std::uint8_t sensor_count_ = 0;
  std::array<std::array<std::uint64_t, 4>, vehicle::kMaxSensors> sensor_frames_{};  // by state
  std::array<std::uint64_t, vehicle::kMaxSensors> packets_fused_{};
  std::array<std::uint32_t, vehicle::kMaxSensors> most_points_{};         // in a frame
  std::array<std::uint32_t, vehicle::kMaxSensors> most_packet_points_{};  // the mean of its packets
  std::vector<FrameRecord> records_;
  RunHash hash_;
  ClassStatistics classes_;
  ObjectStatistics objects_;
};

// "key=value" lines. UsageError if the file cannot be written.
void write_facts(const std::string& path, const Facts& facts);

}  // namespace iog::tools
