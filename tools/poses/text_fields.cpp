#include "tools/poses/text_fields.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>

#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

constexpr std::string_view kBlanks = " \t\r";

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

}  // namespace

std::string_view text_in(const std::string& path, std::span<const std::byte> bytes) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    throw UsageError(path + ": UTF-16 text; save it as UTF-8 (Excel: \"CSV UTF-8\")");
  }
  text.remove_prefix(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
  return text;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(std::min(text.size(), end + (text.substr(end).starts_with("\r\n") ? 2 : 1)));
  }
  return lines;
}

std::vector<std::string_view> parts_of(std::string_view line, char separator) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  for (std::size_t end = line.find(separator); end != std::string_view::npos;
       end = line.find(separator, begin)) {
    parts.push_back(line.substr(begin, end - begin));
    begin = end + 1;
  }
  parts.push_back(line.substr(begin));
  return parts;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (!(line = trimmed(line)).empty()) {
    words.push_back(line.substr(0, line.find_first_of(kBlanks)));
    line.remove_prefix(words.back().size());
  }
  return words;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::optional<std::uint32_t> whole_number_in(std::string_view text) {
  constexpr std::size_t kDigits = 9;
  if (text.empty() || text.size() > kDigits || !std::ranges::all_of(text, is_digit)) {
    return std::nullopt;
  }
  std::uint32_t value = 0;
  for (const char digit : text) {
    value = value * 10 + static_cast<std::uint32_t>(digit - '0');
  }
  return value;
}

std::optional<std::uint64_t> microseconds_in(std::string_view text) {
  constexpr std::size_t kSecondDigits = 12;
  constexpr std::size_t kDecimals = 6;
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string_view whole = text.substr(0, point);
  const std::string_view part = point < text.size() ? text.substr(point + 1) : "";
  if (whole.empty() || whole.size() > kSecondDigits || !std::ranges::all_of(whole, is_digit) ||
      !std::ranges::all_of(part, is_digit)) {
    return std::nullopt;
  }
  std::uint64_t value = 0;
  for (const char digit : whole) {
    value = value * 10 + static_cast<std::uint64_t>(digit - '0');
  }
  for (std::size_t i = 0; i < kDecimals; ++i) {
    value = value * 10 + static_cast<std::uint64_t>(i < part.size() ? part[i] - '0' : 0);
  }
  return value;
}

std::optional<std::uint64_t> seconds_in(std::string_view text) {
  if (text.find_first_of("eE") == std::string_view::npos) {
    return microseconds_in(text);
  }
  constexpr double kMostSeconds = 1e12;
  const std::optional<double> seconds = number_in(text.substr(text.starts_with('+') ? 1 : 0));
  return seconds && *seconds >= 0 && *seconds < kMostSeconds
             ? std::optional(static_cast<std::uint64_t>(std::llround(*seconds * 1e6)))
             : std::nullopt;
}

std::optional<std::uint64_t> unix_us_of(std::uint32_t year, std::uint32_t month, std::uint32_t day,
                                        std::uint64_t time_us) {
  constexpr std::uint64_t kDayUs = 86'400'000'000U;
  const std::chrono::year_month_day date{std::chrono::year(static_cast<int>(year)),
                                         std::chrono::month(month), std::chrono::day(day)};
  // A second may be a leap second.
  if (!date.ok() || year < 1970 || year > 9999 || time_us >= kDayUs + 1'000'000) {
    return std::nullopt;
  }
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  return static_cast<std::uint64_t>(days) * kDayUs + time_us;
}

std::optional<std::uint64_t> date_time_in(std::string_view text) {
  const std::vector<std::string_view> halves = parts_of(trimmed(text), ' ');
  if (halves.size() != 2) {
    return std::nullopt;
  }
  const std::vector<std::string_view> date = parts_of(halves[0], '-');
  const std::vector<std::string_view> clock = parts_of(halves[1], ':');
  if (date.size() != 3 || clock.size() != 3) {
    return std::nullopt;
  }
  const auto year = whole_number_in(date[0]);
  const auto month = whole_number_in(date[1]);
  const auto day = whole_number_in(date[2]);
  const auto hour = whole_number_in(clock[0]);
  const auto minute = whole_number_in(clock[1]);
  const auto second_us = microseconds_in(clock[2]);
  if (!year || !month || !day || !hour || !minute || !second_us || *hour > 23 || *minute > 59 ||
      *second_us > 61'000'000) {
    return std::nullopt;
  }
  return unix_us_of(
      *year, *month, *day,
      (std::uint64_t{*hour} * 3600 + std::uint64_t{*minute} * 60U) * 1'000'000 + *second_us);
}

std::string zero_padded(std::size_t number, std::size_t digits) {
  const std::string text = std::to_string(number);
  return std::string(digits - std::min(digits, text.size()), '0') + text;
}

}  // namespace iog::tools
