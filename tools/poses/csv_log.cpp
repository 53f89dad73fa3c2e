#include <algorithm>
#include <array>
#include <utility>

#include "tools/poses/pose_log.hpp"
#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/printable.hpp"

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

// The fields of a line; quotes around one are taken off.
std::vector<std::string> fields_of(std::string_view line, char separator) {
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (const char letter : line) {
    if (letter == '"') {
      is_quoted = !is_quoted;
    } else if (letter == separator && !is_quoted) {
      fields.emplace_back();
    } else {
      fields.back() += letter;
    }
  }
  for (std::string& field : fields) {
    field = std::string(trimmed(field));
  }
  return fields;
}

// A comma inside a field is a decimal comma.
std::optional<double> decimal_in(std::string text) {
  if (text.find('.') == std::string::npos) {
    std::ranges::replace(text, ',', '.');
  }
  return number_in(std::string_view(text).substr(text.starts_with('+') ? 1 : 0));
}

std::optional<std::uint64_t> time_in(std::string text) {
  std::ranges::replace(text, ',', '.');
  return seconds_in(text);
}

Places places_of(const std::string& place_in_file, const std::vector<std::string>& header,
                 std::vector<std::string>& remarks) {
  Places places{};
  places.fill(kMissing);
  for (std::size_t i = 0; i < header.size(); ++i) {
    const std::string& name = header[i];
    const auto* const found = std::ranges::find(kNames, name);
    if (found == kNames.end()) {
      remarks.push_back("column '" + printable(name) + "'");
      continue;
    }
    std::size_t& place = places[static_cast<std::size_t>(found - kNames.begin())];
    if (place != kMissing) {
      throw UsageError(std::string(place_in_file)
                           .append(": the column ")
                           .append(name)
                           .append(" is there twice"));
    }
    place = i;
  }
  for (std::size_t column = 0; column < kRequired; ++column) {
    if (places[column] == kMissing) {
      throw UsageError(place_in_file + ": no column " + std::string(kNames[column]) +
                       "; the first line names the columns, at least time_s,x_m,y_m,heading_deg");
    }
  }
  return places;
}

// Reads the rows of one file, and says where it is when it cannot.
class Row {
 public:
  Row(std::string place_in_file, const Places& places, const std::vector<std::string>& fields)
      : place_(std::move(place_in_file)), places_(&places), fields_(&fields) {}

  // Spreadsheets end lines with empty fields.
  void demand_fields(std::size_t count) const {
    const auto is_empty = [](const std::string& field) { return field.empty(); };
    if (fields_->size() < count ||
        !std::all_of(fields_->begin() + static_cast<std::ptrdiff_t>(count), fields_->end(),
                     is_empty)) {
      fail(std::to_string(fields_->size()) + " values for " + std::to_string(count) + " columns");
    }
  }

  [[nodiscard]] std::uint64_t time_us() const {
    const std::optional<std::uint64_t> time = time_in(text_of(kTime));
    if (!time) {
      fail("time_s is '" + printable(text_of(kTime)) + "': give seconds, 0 or more");
    }
    return *time;
  }

  [[nodiscard]] double number(Column column) const {
    const std::optional<double> value = decimal_in(text_of(column));
    if (!value) {
      fail(std::string(kNames[column]) + " is '" + printable(text_of(column)) +
           "', which is not a number");
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
  [[nodiscard]] const std::string& text_of(Column column) const {
    return (*fields_)[(*places_)[column]];
  }

  [[noreturn]] void fail(const std::string& why) const { throw UsageError(place_ + ": " + why); }

  std::string place_;
  const Places* places_;
  const std::vector<std::string>* fields_;
};

// Comments and what is empty but for separators.
bool is_passed_over(std::string_view line) {
  return line.starts_with('#') || line.find_first_not_of(" \t,;\"") == std::string_view::npos;
}

// A header may stand behind a '#'.
bool is_hidden_header(std::string_view line) {
  return line.starts_with('#') && line.find(kNames[kTime]) != std::string_view::npos;
}

// The line that names the columns. "sep=;" is for Excel. If what is no comment begins with a
// number, the names are those of the comment before it, in whatever language.
std::size_t header_of(const std::vector<std::string_view>& lines) {
  std::size_t first = 0;
  while (first < lines.size() && !is_hidden_header(lines[first]) &&
         (is_passed_over(lines[first]) || lines[first].starts_with("sep="))) {
    ++first;
  }
  const bool is_row = first > 0 && first < lines.size() && lines[first - 1].starts_with('#') &&
                      lines[first].find_first_of("0123456789") == 0;
  return is_row ? first - 1 : first;
}

}  // namespace

PoseLog read_csv_log(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::vector<std::string_view> lines = lines_of(text_in(path, bytes));
  const auto place_of = [&path](std::size_t i) { return path + ':' + std::to_string(i + 1); };
  const std::size_t first = header_of(lines);
  if (first == lines.size()) {
    throw empty_file(path);
  }
  PoseLog log;
  const std::string_view names = lines[first].substr(lines[first].starts_with('#') ? 1 : 0);
  const std::size_t separator = names.find_first_of(";\t");
  const char mark = separator == std::string_view::npos ? ',' : names[separator];
  std::vector<std::string> header = fields_of(names, mark);
  while (!header.empty() && header.back().empty()) {
    header.pop_back();
  }
  const Places places = places_of(place_of(first), header, log.remarks);
  for (std::size_t i = first + 1; i < lines.size(); ++i) {
    if (is_passed_over(lines[i])) {
      continue;
    }
    const std::vector<std::string> fields = fields_of(lines[i], mark);
    const Row row(place_of(i), places, fields);
    row.demand_fields(header.size());
    log.poses.push_back({.time_us = row.time_us(),
                         .x_m = row.number(kX),
                         .y_m = row.number(kY),
                         .heading_rad = row.number(kHeading) * kRadians,
                         .speed_mps = row.if_there(kSpeed, 1),
                         .yaw_rate_rps = row.if_there(kYawRate, kRadians),
                         .sigma_m = row.sigma(kSigma, 1),
                         .sigma_heading_rad = row.sigma(kSigmaHeading, kRadians),
                         .place = i + 1});
  }
  return log;
}

}  // namespace iog::tools
