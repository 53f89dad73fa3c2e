// Points whose coordinates are found by the names of their fields, as PCD files and
// sensor_msgs/PointCloud2 keep them: x and y, and z if it is there, in metres; when each was seen,
// if it is there: `t`, `time`, `timestamp`, `time_stamp` or `offset_time`.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/points/points_writer.hpp"

namespace iog::tools {

// What a lidar saw in one scan.
struct SeenCloud {
  std::string frame{};              // in which its points are; empty: not known
  std::uint64_t time_us = 0;        // that of its first point, since 1970; 0: no stamp
  bool has_times = false;           // of its points
  std::string viewpoint{};          // of the file, with its keyword; empty: the origin; not used
  bool is_assumed = false;          // time_us: neither a stamp nor a point gives it
  std::uint64_t since_1970_us = 0;  // of its first point by its own time, 2001 to 2096; else 0
  double apart_us = 0;   // from the points' own times to the stamp, which is used; 0: below 1 s
  double time_span = 0;  // of its points, in their own unit
  bool has_unknown_times = false;   // its points' times are left out: their unit is not known
  double view_deg = 360;            // of a scan's beams
  bool has_wrong_times = false;     // those of its beams are left out: they are of no scan
  bool is_at_once = false;          // a scan of several beams whose times from beam to beam are 0
  std::vector<WirePoint> points{};  // azimuths, elevations and ranges
  std::uint64_t not_finite = 0;     // left out: a coordinate is no number
  std::uint64_t nowhere = 0;        // left out: at the sensor itself, or nearer than it measures
  std::uint64_t outside = 0;        // left out: outside of the car file's field of view
  std::uint64_t at_range_max = 0;   // kept as beams without a return: LaserRanges::most_m away
  std::uint64_t untimed = 0;  // left out: their time is no number, or 0 among others since 1970
};

// A unit with a wider view spins, even with a small gap in it.
inline constexpr double kWholeTurnDeg = 350;

// Unit of the points' times. A cloud shows it if its points are 5 to 500 ms apart in that unit, and
// it has at least 100 points, or the field's type agrees (seconds in floats, nanoseconds in
// integers).
enum class TimeUnit : std::uint8_t { kFound, kSeconds, kMilliseconds, kMicroseconds, kNanoseconds };
// From kSeconds on, as --time-unit has them.
inline constexpr std::array<std::string_view, 4> kTimeUnitNames{"s", "ms", "us", "ns"};

struct CloudField {
  enum class Kind : std::uint8_t { kSigned, kUnsigned, kFloat };

  std::string name;
  Kind kind = Kind::kFloat;
  std::size_t bytes = 4;   // of one number
  std::size_t at = 0;      // of the first point
  std::size_t stride = 0;  // from one point to the next
};

struct CloudRecords {
  std::vector<CloudField> fields{};
  std::size_t count = 0;  // of points
  std::span<const std::byte> bytes{};
  bool is_big_endian = false;
  std::uint64_t stamp_us = 0;  // of the scan, since 1970
};

// The number of that field, which lies within the bytes, in a record.
[[nodiscard]] double number_at(const CloudRecords& records, const CloudField& field,
                               std::size_t record);

// Coordinates become directions and ranges, and the points' times count from the first one. Points
// without a place, a direction or a time are left out and counted. Sets unit if it is kFound and
// this cloud shows the unit. UsageError, which begins with `what`: no x or y, more points than a
// unit sees, fields outside of the bytes, times that are those of no scan.
[[nodiscard]] SeenCloud cloud_of(const CloudRecords& records, TimeUnit& unit,
                                 const std::string& what);

// Returns a sentence on SeenCloud::apart_us, which is above 0.
[[nodiscard]] std::string words_of_other_clock(double apart_us);

// Returns a sentence if `given` is too short a unit, else nothing: a scan of `span` lasts less than
// 5 ms in it, but 5 to 500 ms, and at most 1.5 `period_us`, in a longer unit. period_us is the time
// from scan to scan; 0: unknown, which returns nothing.
[[nodiscard]] std::string words_of_wrong_unit(TimeUnit given, double span, double period_us);

// The least time from scan to scan (docs/sensors.md), and of a car file's frame_period_us.
inline constexpr double kShortestPeriodUs = 10'000;
// Returns a sentence if clouds come more often than that, else nothing. 0: unknown.
[[nodiscard]] std::string words_of_short_period(double period_us);

// Farther than any unit can measure.
inline constexpr std::int32_t kFarthestMm = 500'000;

// Detects coordinates in another unit or byte order, which would free everything around the car.
// Throws a UsageError that begins with `what` if more than half of the points are farther away than
// kFarthestMm.
void demand_metres(std::size_t far, std::size_t points, const std::string& what);

// UsageError, which begins with `what`, for more points than a unit sees in a scan.
void check_count(const CloudRecords& records, const std::string& what);

// Points one behind another, `stride` bytes each. UsageError, which begins with `what`, if a field
// is outside of them, or the bytes are not those of count points.
void set_stride(CloudRecords& records, std::size_t stride, const std::string& what);

// UsageError, which begins with `what`, if the records have as many fields as they may.
void add_field(CloudRecords& records, CloudField field, const std::string& what);

// A field of one of the types of sensor_msgs/PointField, 1 ... 8. UsageError, which begins with
// `what`, for another.
[[nodiscard]] CloudField field_of_type(const std::string& name, std::size_t type,
                                       const std::string& what);

// Rows of a text, in lines of their own that are not blank.
struct TextRows {
  std::span<const std::byte> text{};
  std::size_t line = 1;     // number of the first one in its file
  std::size_t rows = 0;     // at most so many are read
  std::size_t columns = 0;  // numbers in each row
};

// Their numbers as little-endian doubles; `text` becomes what is behind them. UsageError, which
// begins with `path`, for a row of more or fewer numbers, or for a word that is no number.
[[nodiscard]] std::vector<std::byte> doubles_in(TextRows& text, const std::string& path);

// A whole number of a file's head. UsageError, which begins with `path`, for any other word.
[[nodiscard]] std::size_t whole_number_of(std::string_view word, const std::string& path);

}  // namespace iog::tools
