// Lines, numbers and times in the text of logs, read without surprises: the whole field or nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace iog::tools {

// The text of a file, without a byte order mark. UsageError if it is UTF-16.
[[nodiscard]] std::string_view text_in(const std::string& path, std::span<const std::byte> bytes);

// Lines that end with LF, CR or both.
[[nodiscard]] std::vector<std::string_view> lines_of(std::string_view text);

// The parts of a line between separators; an empty line is one empty part.
[[nodiscard]] std::vector<std::string_view> parts_of(std::string_view line, char separator);

// What stands between blanks.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line);

// Without blanks at both ends, and without a carriage return.
[[nodiscard]] std::string_view trimmed(std::string_view text);

// A finite decimal number and nothing else.
[[nodiscard]] std::optional<double> number_in(std::string_view text);

// An unsigned whole number of at most nine digits and nothing else.
[[nodiscard]] std::optional<std::uint32_t> whole_number_in(std::string_view text);

// Seconds with or without decimals as microseconds, exactly; what is beyond the sixth decimal is
// cut off. At most 12 digits before the point, no sign.
[[nodiscard]] std::optional<std::uint64_t> microseconds_in(std::string_view text);

// The same or, rounded, with an exponent, as numpy writes it; then below 10^12 s.
[[nodiscard]] std::optional<std::uint64_t> seconds_in(std::string_view text);

// Microseconds since 1970 of a day and a time of it (UTC, no leap seconds). Empty: no such day.
[[nodiscard]] std::optional<std::uint64_t> unix_us_of(std::uint32_t year, std::uint32_t month,
                                                      std::uint32_t day, std::uint64_t time_us);

// As KITTI writes it: "2011-09-26 13:02:25.964389445"; what is beyond microseconds is cut off.
[[nodiscard]] std::optional<std::uint64_t> date_time_in(std::string_view text);

// "0000000123": at least so many digits.
[[nodiscard]] std::string zero_padded(std::size_t number, std::size_t digits);

}  // namespace iog::tools
