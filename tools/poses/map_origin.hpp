// Where the plane of a map touches the earth, as people write it and as maps and poses name it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "map/origin.hpp"
#include "tools/poses/local_plane.hpp"

namespace iog::tools {

// 1e-9 degrees.
struct MapOrigin {
  std::int64_t latitude = 0;
  std::int64_t longitude = 0;

  [[nodiscard]] std::uint64_t name() const { return map::origin_name(latitude, longitude); }
  [[nodiscard]] LocalPlane plane() const;
  friend bool operator==(const MapOrigin&, const MapOrigin&) = default;
};

// Of its latitude: near a pole east is everywhere.
inline constexpr std::int64_t kMostLatitude = 80'000'000'000;

// "49.0,-8.4": decimal degrees, at most nine decimals, exactly as they stand there. UsageError,
// which begins with the option's name, if it is not so, or beyond 80 or 180 degrees.
[[nodiscard]] MapOrigin map_origin_in(const std::string& option, std::string_view text);

// As map_origin_in() reads it.
[[nodiscard]] std::string text_of(const MapOrigin& origin);

// A whole number of units of 10^-decimals degrees: "-48.8766670" of -488,766,670 and 7.
[[nodiscard]] std::string decimal_degrees(std::int64_t units, int decimals);

}  // namespace iog::tools
