#include "tools/clouds/cloud_fields.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

#include "tools/clouds/point_cloud.hpp"
#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/fixed.hpp"
#include "tools/program/printable.hpp"
#include "tools/program/table.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

constexpr double kLongestScanUs = 500'000;
constexpr double kShortestScanUs = 5'000;
constexpr std::size_t kEnoughPoints = 100;
constexpr std::size_t kMostFields = 64;
constexpr std::array<double, 4> kUnits{1e6, 1e3, 1, 1e-3};  // as TimeUnit, in microseconds

const CloudField* field_of(const CloudRecords& records, std::string_view name) {
  const auto found = std::ranges::find(records.fields, name, &CloudField::name);
  return found == records.fields.end() ? nullptr : &*found;
}

const CloudField* time_field_of(const CloudRecords& records) {
  for (const std::string_view name : {"t", "time", "timestamp", "time_stamp", "offset_time"}) {
    if (const CloudField* const field = field_of(records, name)) {
      return field;
    }
  }
  return nullptr;
}

void check(const CloudRecords& records, const std::string& what) {
  check_count(records, what);
  for (const std::string_view name : {"x", "y"}) {
    if (field_of(records, name) == nullptr) {
      throw UsageError(what + ": its points have no field " + std::string(name));
    }
  }
  for (const CloudField& field : records.fields) {
    const bool is_known = field.kind == CloudField::Kind::kFloat
                              ? field.bytes == 4 || field.bytes == 8
                              : std::has_single_bit(field.bytes) && field.bytes <= 8;
    if (!is_known) {
      throw UsageError(what + ": field " + field.name + " has an unknown type");
    }
    // The place and the stride alone first, so that nothing overflows.
    if (records.count > 0 &&
        (field.at > records.bytes.size() ||
         (records.count > 1 && field.stride > records.bytes.size()) ||
         field.at + (records.count - 1) * field.stride + field.bytes > records.bytes.size())) {
      throw UsageError(what + ": it ends before its " + std::to_string(records.count) + " points");
    }
  }
}

// The unit that a cloud shows whose points lie `span` apart. A cloud of few points may be a part of
// a scan, which is a whole scan in a wrong unit.
TimeUnit unit_of(double span, std::size_t points, CloudField::Kind kind) {
  const auto found = std::ranges::find_if(kUnits, [&](double us) {
    return span * us >= kShortestScanUs && span * us <= kLongestScanUs;
  });
  if (found == kUnits.end()) {
    return TimeUnit::kFound;
  }
  const auto unit = static_cast<TimeUnit>(found - kUnits.begin() + 1);
  const TimeUnit usual =
      kind == CloudField::Kind::kFloat ? TimeUnit::kSeconds : TimeUnit::kNanoseconds;
  return points >= kEnoughPoints || unit == usual ? unit : TimeUnit::kFound;
}

// Times of points, of which a few may be none: 0 among times since 1970, or no number.
class PointTimes {
 public:
  explicit PointTimes(std::vector<double> times) : times_(std::move(times)) {
    std::ranges::copy_if(times_, std::back_inserter(sorted_),
                         [](double time) { return std::isfinite(time); });
    std::ranges::sort(sorted_);
  }

  [[nodiscard]] double at(std::size_t point) const { return times_[point]; }
  [[nodiscard]] double first() const { return sorted_.front(); }
  [[nodiscard]] bool has_most() const {
    return !sorted_.empty() && 2 * sorted_.size() > times_.size();
  }

  // From the first one to the last one.
  [[nodiscard]] double span() const { return sorted_.back() - sorted_.front(); }
  // That of all but the outer tenths, if the others are that far away from it.
  [[nodiscard]] std::optional<double> inner_span() const {
    constexpr double kFar = 100;
    const std::size_t outer = sorted_.size() / 10;
    const double inner = sorted_[sorted_.size() - 1 - outer] - sorted_[outer];
    return inner > 0 && span() > kFar * inner ? std::optional(inner) : std::nullopt;
  }

  // Takes those for none that are farther from the one in the middle, if few are.
  void drop_beyond(double distance) {
    constexpr std::size_t kFew = 10;  // one in ten
    const double middle = sorted_[sorted_.size() / 2];
    const auto is_beyond = [&](double time) { return !(std::abs(time - middle) <= distance); };
    if (kFew * static_cast<std::size_t>(std::ranges::count_if(sorted_, is_beyond)) <=
        sorted_.size()) {
      std::ranges::replace_if(times_, is_beyond, std::numeric_limits<double>::quiet_NaN());
      std::erase_if(sorted_, is_beyond);
    }
  }

  // Leaves out points without a time.
  void remove_untimed(SeenCloud& cloud) {
    std::size_t point = 0;
    std::erase_if(cloud.points, [&](const WirePoint&) { return !std::isfinite(times_[point++]); });
    std::erase_if(times_, [](double time) { return !std::isfinite(time); });
    cloud.untimed = point - cloud.points.size();
  }

 private:
  std::vector<double> times_;
  std::vector<double> sorted_;  // the finite ones
};

// From here on, float32 numbers are 8 or more apart.
constexpr double kCoarsestFloat32 = 1e8;

// 0: it is no time of 2001 to 2096.
std::uint64_t since_1970_us(double us) {
  constexpr double kSeptember2001Us = 1e15;
  return us >= kSeptember2001Us && us < 4 * kSeptember2001Us ? static_cast<std::uint64_t>(us) : 0;
}

// When each of the points that are kept was seen; the earliest is the cloud's time, if it is one
// that counts from 1970, or from the scan's stamp.
void add_times(const CloudRecords& records, const CloudField& field,
               const std::vector<std::size_t>& kept, TimeUnit& unit, const std::string& what,
               SeenCloud& cloud) {
  std::vector<double> all;
  std::ranges::transform(kept, std::back_inserter(all),
                         [&](std::size_t point) { return number_at(records, field, point); });
  PointTimes times(std::move(all));
  if (!times.has_most()) {  // of a driver that has no times
    return;
  }
  const double span = times.inner_span().value_or(times.span());
  // Float32 has times of 2001 and later in steps of 64 s or more. A text can be finer.
  const bool is_float32 = field.kind == CloudField::Kind::kFloat && field.bytes < 8 &&
                          static_cast<double>(static_cast<float>(times.first())) == times.first();
  if (is_float32 && std::abs(times.first()) >= kCoarsestFloat32) {
    return;
  }
  if (span == 0) {
    for (const double us : kUnits) {  // of which one at most fits
      const std::uint64_t its_us = since_1970_us(times.first() * us);
      cloud.since_1970_us = its_us > 0 ? its_us : cloud.since_1970_us;
    }
    times.remove_untimed(cloud);
    return;
  }
  cloud.time_span = span;
  unit = unit == TimeUnit::kFound ? unit_of(span, kept.size(), field.kind) : unit;
  if (unit == TimeUnit::kFound) {
    cloud.has_unknown_times = true;
    return;
  }
  const double us = kUnits.at(static_cast<std::size_t>(unit) - 1);
  times.drop_beyond(1e6 / us);
  times.remove_untimed(cloud);
  if (!(times.span() * us <= 1e6)) {
    throw UsageError(what + ": its points are more than a second apart");
  }
  const double first = times.first();
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    cloud.points[i].after_us = static_cast<std::uint32_t>(std::lround((times.at(i) - first) * us));
  }
  const auto stamp_us = static_cast<double>(records.stamp_us);
  const double first_us = first * us;
  const double begin_us = first_us < 1e12 ? stamp_us + first_us : first_us;
  cloud.has_times = true;
  cloud.since_1970_us = since_1970_us(first_us);
  if (records.stamp_us == 0 && cloud.since_1970_us > 0) {
    cloud.time_us = cloud.since_1970_us;  // the driver has not set the stamp
    return;
  }
  const double apart_us = std::abs(begin_us - stamp_us);
  cloud.apart_us = apart_us > 1e6 ? apart_us : 0;
  cloud.time_us =
      apart_us <= 1e6 && begin_us >= 0 ? static_cast<std::uint64_t>(begin_us) : records.stamp_us;
}

}  // namespace

double number_at(const CloudRecords& records, const CloudField& field, std::size_t record) {
  const auto bytes = records.bytes.subspan(field.at + record * field.stride, field.bytes);
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < field.bytes; ++i) {
    const std::byte byte = bytes[records.is_big_endian ? field.bytes - 1 - i : i];
    bits |= std::to_integer<std::uint64_t>(byte) << 8 * i;
  }
  const int spare = 64 - 8 * static_cast<int>(field.bytes);
  switch (field.kind) {
    case CloudField::Kind::kUnsigned:
      return static_cast<double>(bits);
    case CloudField::Kind::kSigned:
      return static_cast<double>(static_cast<std::int64_t>(bits << spare) >> spare);
    case CloudField::Kind::kFloat:
      break;
  }
  return field.bytes == 8
             ? std::bit_cast<double>(bits)
             : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
}

void demand_metres(std::size_t far, std::size_t points, const std::string& what) {
  if (2 * far > points) {
    throw UsageError(what + ": " + std::to_string(far) + " of its " + std::to_string(points) +
                     " points are more than " + std::to_string(kFarthestMm / 1000) +
                     " m away; coordinates are metres");
  }
}

void check_count(const CloudRecords& records, const std::string& what) {
  if (records.count > kMostCloudPoints) {
    throw UsageError(what + ": " + std::to_string(records.count) +
                     " points; no unit sees more than " + std::to_string(kMostCloudPoints) +
                     " in a scan");
  }
}

void set_stride(CloudRecords& records, std::size_t stride, const std::string& what) {
  check_count(records, what);
  const bool is_empty = records.count == 0 && records.bytes.empty();  // then its head may be, too
  for (CloudField& field : records.fields) {
    field.stride = stride;
    if (!is_empty && field.at + field.bytes > stride) {
      throw UsageError(what + ": field " + printable(field.name) + " ends at byte " +
                       std::to_string(field.at + field.bytes) + " of a point, which has " +
                       std::to_string(stride));
    }
  }
  if (records.count * stride != records.bytes.size()) {
    throw UsageError(what + ": its " +
                     counted(records.count, "point|points of " + std::to_string(stride) +
                                                " bytes does|do not fill its ") +
                     std::to_string(records.bytes.size()) + " bytes");
  }
}

void add_field(CloudRecords& records, CloudField field, const std::string& what) {
  if (records.fields.size() == kMostFields) {
    throw UsageError(what + ": its points have more than " + std::to_string(kMostFields) +
                     " fields");
  }
  records.fields.push_back(std::move(field));
}

CloudField field_of_type(const std::string& name, std::size_t type, const std::string& what) {
  using Kind = CloudField::Kind;
  struct Type {
    Kind kind;
    std::size_t bytes;
  };
  constexpr Type kTypes[]{{Kind::kSigned, 1},   {Kind::kUnsigned, 1}, {Kind::kSigned, 2},
                          {Kind::kUnsigned, 2}, {Kind::kSigned, 4},   {Kind::kUnsigned, 4},
                          {Kind::kFloat, 4},    {Kind::kFloat, 8}};
  if (type == 0 || type > std::size(kTypes)) {
    throw UsageError(what + ": field " + printable(name) + " has an unknown type, " +
                     std::to_string(type));
  }
  return {.name = name, .kind = kTypes[type - 1].kind, .bytes = kTypes[type - 1].bytes};
}

std::vector<std::byte> doubles_in(TextRows& text, const std::string& path) {
  std::vector<std::byte> bytes;
  for (std::size_t rows = 0; rows < text.rows && !text.text.empty(); ++text.line) {
    const auto end = std::ranges::find(text.text, std::byte{'\n'});
    const auto length = static_cast<std::size_t>(end - text.text.begin());
    const auto words = words_of({reinterpret_cast<const char*>(text.text.data()), length});
    text.text = text.text.subspan(std::min(length + 1, text.text.size()));
    if (words.empty()) {
      continue;
    }
    ++rows;
    const std::string where = path + ":" + std::to_string(text.line) + ": ";
    if (words.size() != text.columns) {
      throw UsageError(where + std::to_string(words.size()) + " numbers instead of " +
                       std::to_string(text.columns));
    }
    for (const std::string_view word : words) {
      double number = 0;
      const auto [stop, error] = std::from_chars(word.begin(), word.end(), number);
      if (error != std::errc() || stop != word.end()) {
        throw UsageError(where + "'" + printable(std::string(word)) + "' is not a number");
      }
      bytes.resize(bytes.size() + 8);
      wire::store_le64(std::span(bytes).last<8>(), std::bit_cast<std::uint64_t>(number));
    }
  }
  return bytes;
}

std::size_t whole_number_of(std::string_view word, const std::string& path) {
  if (const std::optional<std::uint32_t> number = whole_number_in(word)) {
    return *number;
  }
  throw UsageError(path + ": in its head '" + printable(std::string(word)) +
                   "' is not a whole number, or is too large");
}

SeenCloud cloud_of(const CloudRecords& records, TimeUnit& unit, const std::string& what) {
  check(records, what);
  const CloudField& x_field = *field_of(records, "x");
  const CloudField& y_field = *field_of(records, "y");
  const CloudField* const z_field = field_of(records, "z");
  SeenCloud cloud{.time_us = records.stamp_us};
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < records.count; ++i) {
    const double x = number_at(records, x_field, i);
    const double y = number_at(records, y_field, i);
    const double z = z_field == nullptr ? 0 : number_at(records, *z_field, i);
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
      ++cloud.not_finite;
      continue;
    }
    const WirePoint point = direction_of(x, y, z);
    if (point.third == 0) {
      ++cloud.nowhere;
      continue;
    }
    kept.push_back(i);
    cloud.points.push_back(point);
  }
  const CloudField* const time_field = time_field_of(records);
  if (time_field != nullptr && !kept.empty()) {
    add_times(records, *time_field, kept, unit, what, cloud);
  }
  return cloud;
}

std::string words_of_wrong_unit(TimeUnit given, double span, double period_us) {
  constexpr double kMostPeriods = 1.5;  // a stamp may be late
  if (given == TimeUnit::kFound) {
    return {};
  }
  const std::size_t its = static_cast<std::size_t>(given) - 1;
  const TimeUnit other = unit_of(span, kEnoughPoints, CloudField::Kind::kFloat);
  const std::size_t right = static_cast<std::size_t>(other) - 1;
  if (other == TimeUnit::kFound || right >= its ||
      span * kUnits.at(right) > kMostPeriods * period_us) {
    return {};
  }
  std::ostringstream text;
  text << "with --time-unit " << kTimeUnitNames.at(its) << " a scan lasts " << span << ' '
       << kTimeUnitNames.at(its) << ", not 5 to 500 ms: try --time-unit "
       << kTimeUnitNames.at(right);
  return text.str();
}

std::string words_of_short_period(double period_us) {
  return period_us <= 0 || period_us >= kShortestPeriodUs
             ? ""
             : "a cloud comes every " + fixed(period_us / 1000, 1) +
                   " ms, and the target accepts one every 10 ms: let the lidar's driver publish "
                   "whole turns or scans";
}

std::string words_of_other_clock(double apart_us) {
  return "points' times are " + fixed(apart_us / 1e6, 1) +
         " s from their clouds' stamps; each cloud's first point is put at its stamp";
}

}  // namespace iog::tools
