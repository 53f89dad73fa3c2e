#include <algorithm>
#include <array>

#include "tools/poses/pose_log.hpp"
#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

enum Column : std::uint8_t {
  kTime,
  kX,
  kY,
  kHeading,
  kSpeed,
  kYawRate,
  kSigma,
  kSigmaHeading,
  kColumnCount
};
constexpr std::array<std::string_view, kColumnCount> kNames{
    "time_s",           "x_m", "y_m", "heading_deg", "speed_m_s", "yaw_rate_deg_s", "sigma_m",
    "sigma_heading_deg"};
constexpr std::size_t kRequired = kHeading + 1;
constexpr std::size_t kMissing = static_cast<std::size_t>(-1);

// The place of each column in a row.
using Places = std::array<std::size_t, kColumnCount>;

Places places_of(const std::string& path, const std::vector<std::string_view>& header,
                 std::vector<std::string>& remarks) {
  Places places{};
  places.fill(kMissing);
  for (std::size_t i = 0; i < header.size(); ++i) {
    const std::string_view name = trimmed(header[i]);
    const auto* const found = std::ranges::find(kNames, name);
    if (found == kNames.end()) {
      remarks.push_back("column '" + std::string(name) + "'");
      continue;
    }
    std::size_t& place = places[static_cast<std::size_t>(found - kNames.begin())];
    if (place != kMissing) {
      throw UsageError(path + ":1: the column " + std::string(name) + " is there twice");
    }
    place = i;
  }
  for (std::size_t column = 0; column < kRequired; ++column) {
    if (places[column] == kMissing) {
      throw UsageError(path + ":1: no column " + std::string(kNames[column]) +
                       "; the first line names the columns, at least time_s,x_m,y_m,heading_deg");
    }
  }
  return places;
}

// Reads the rows of one file, and says where it is when it cannot.
class Row {
 public:
  Row(const std::string& path, std::size_t line, const Places& places, std::string_view text)
      : path_(&path), line_(line), places_(&places), parts_(parts_of(text, ',')) {}

  void demand_parts(std::size_t count) const {
    if (parts_.size() != count) {
      fail(std::to_string(parts_.size()) + " values for " + std::to_string(count) + " columns");
    }
  }

  [[nodiscard]] std::uint64_t time_us() const {
    const std::optional<std::uint64_t> time = microseconds_in(text_of(kTime));
    if (!time) {
      fail("time_s is '" + std::string(text_of(kTime)) + "': give seconds, 0 or more");
    }
    return *time;
  }

  [[nodiscard]] double number(Column column) const {
    const std::optional<double> value = number_in(text_of(column));
    if (!value) {
      fail(std::string(kNames[column]) + " is '" + std::string(text_of(column)) +
           "', which is no number");
    }
    return *value;
  }

  // Empty if there is no such column, or nothing in it.
  [[nodiscard]] std::optional<double> if_there(Column column, double unit) const {
    if ((*places_)[column] == kMissing || text_of(column).empty()) {
      return std::nullopt;
    }
    return number(column) * unit;
  }

  [[nodiscard]] std::optional<double> sigma(Column column, double unit) const {
    const std::optional<double> value = if_there(column, unit);
    if (value && *value < 0) {
      fail(std::string(kNames[column]) + " is negative");
    }
    return value;
  }

 private:
  [[nodiscard]] std::string_view text_of(Column column) const {
    return trimmed(parts_[(*places_)[column]]);
  }

  [[noreturn]] void fail(const std::string& why) const {
    throw UsageError(*path_ + ":" + std::to_string(line_) + ": " + why);
  }

  const std::string* path_;
  std::size_t line_;
  const Places* places_;
  std::vector<std::string_view> parts_;
};

}  // namespace

PoseLog read_csv_log(const std::string& path) {
  const std::vector<std::string> lines = read_lines(path);
  if (lines.empty()) {
    throw UsageError(path + ": empty");
  }
  PoseLog log;
  const std::vector<std::string_view> header = parts_of(lines.front(), ',');
  const Places places = places_of(path, header, log.remarks);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (trimmed(lines[i]).empty()) {
      continue;
    }
    const Row row(path, i + 1, places, lines[i]);
    row.demand_parts(header.size());
    log.poses.push_back({.time_us = row.time_us(),
                         .x_m = row.number(kX),
                         .y_m = row.number(kY),
                         .heading_rad = row.number(kHeading) * kRadians,
                         .speed_mps = row.if_there(kSpeed, 1),
                         .yaw_rate_rps = row.if_there(kYawRate, kRadians),
                         .sigma_m = row.sigma(kSigma, 1),
                         .sigma_heading_rad = row.sigma(kSigmaHeading, kRadians)});
  }
  return log;
}

}  // namespace iog::tools
