#include "tools/poses/map_origin.hpp"

#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <vector>

#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

constexpr int kDegreeDecimals = 9;
constexpr std::int64_t kDegree = 1'000'000'000;
constexpr std::int64_t kMaxLongitude = 180 * kDegree;

// Digits alone, at most `most` of them; none is 0.
std::optional<std::int64_t> digits_in(std::string_view text, std::size_t most) {
  std::int64_t value = 0;
  if (text.empty()) {
    return value;
  }
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = text.size() <= most && text.front() != '-' && read.ec == std::errc() &&
                         read.ptr == text.data() + text.size();
  return is_number ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> angle_in(std::string_view text) {
  const bool is_negative = text.starts_with('-');
  text.remove_prefix(is_negative ? 1 : 0);
  const std::size_t point = text.find('.');
  const std::string_view whole = text.substr(0, point);
  std::string decimals(point == std::string_view::npos ? "" : text.substr(point + 1));
  if (whole.empty() || decimals.size() > kDegreeDecimals) {
    return std::nullopt;
  }
  decimals.resize(kDegreeDecimals, '0');
  const auto degrees = digits_in(whole, 3);
  const auto rest = digits_in(decimals, kDegreeDecimals);
  if (!degrees || !rest) {
    return std::nullopt;
  }
  const std::int64_t angle = *degrees * kDegree + *rest;
  return is_negative ? -angle : angle;
}

}  // namespace

LocalPlane MapOrigin::plane() const {
  return {static_cast<double>(latitude) / kDegree, static_cast<double>(longitude) / kDegree};
}

MapOrigin map_origin_in(const std::string& option, std::string_view text) {
  const std::vector<std::string_view> parts = parts_of(text, ',');
  if (parts.size() == 2) {
    const auto latitude = angle_in(trimmed(parts[0]));
    const auto longitude = angle_in(trimmed(parts[1]));
    if (latitude && longitude && std::abs(*latitude) <= kMostLatitude &&
        std::abs(*longitude) <= kMaxLongitude) {
      return {*latitude, *longitude};
    }
  }
  throw UsageError(option + " " + std::string(text) +
                   ": give latitude and longitude in degrees, as in 49.0125,-8.4");
}

std::string text_of(const MapOrigin& origin) {
  return decimal_degrees(origin.latitude, kDegreeDecimals) + ',' +
         decimal_degrees(origin.longitude, kDegreeDecimals);
}

std::string decimal_degrees(std::int64_t units, int decimals) {
  std::int64_t degree = 1;
  for (int i = 0; i < decimals; ++i) {
    degree *= 10;
  }
  const std::int64_t size = std::abs(units);
  // A leading 1 keeps the zeros behind the point.
  const std::string rest = std::to_string(degree + size % degree);
  std::string text = units < 0 ? "-" : "";
  text += std::to_string(size / degree);
  text += '.';
  return text.append(rest, 1);
}

}  // namespace iog::tools
