// A map as its source has it: latitude and longitude, areas and lines of roads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "map/block.hpp"
#include "tools/map/census.hpp"

namespace iog::tools {

// Degrees, WGS 84.
struct GeoPoint {
  double latitude = 0;
  double longitude = 0;
};

struct GeoBox {
  double south = 90;
  double west = 180;
  double north = -90;
  double east = -180;

  void extend(const GeoPoint& point) {
    south = std::min(south, point.latitude);
    north = std::max(north, point.latitude);
    west = std::min(west, point.longitude);
    east = std::max(east, point.longitude);
  }
  [[nodiscard]] bool is_empty() const { return south > north || west > east; }
};

// The box of points, also of those around 180 degrees, where the usual longitudes jump: there west
// is below and east above 180.
class GeoExtent {
 public:
  GeoExtent() = default;
  explicit GeoExtent(const GeoBox& box) {
    extend({box.south, box.west});
    extend({box.north, box.east});
  }

  void extend(const GeoPoint& point) {
    usual_.extend(point);
    eastward_.extend(
        {point.latitude, point.longitude < 0 ? point.longitude + 360 : point.longitude});
  }
  [[nodiscard]] bool is_empty() const { return usual_.is_empty(); }
  [[nodiscard]] bool crosses_180() const {
    return usual_.east - usual_.west > 180 && eastward_.east - eastward_.west < 180;
  }
  // crosses_180: whether longitudes are to be those of 0 to 360 degrees.
  [[nodiscard]] const GeoBox& box(bool crosses_180) const {
    return crosses_180 ? eastward_ : usual_;
  }

 private:
  GeoBox usual_;
  GeoBox eastward_{.south = 90, .west = 360, .north = -90, .east = 0};
};

// `id` is how the source calls an object, `as` what the census counts it as if it is taken.

// The inside of its rings, even-odd. A ring's last point is not its first.
struct GeoArea {
  map::Kind kind = map::Kind::kBuilding;
  std::vector<std::vector<GeoPoint>> rings{};
  std::string id{};
  const char* as = "buildings";
};

// A road by its middle. Where it meets another one, its end is round.
struct GeoRoad {
  double width_m = 0;
  std::vector<GeoPoint> line{};
  bool is_round_at_start = false;
  bool is_round_at_end = false;
  std::string id{};
  const char* as = "roads";
  const char* assumed = "";  // why its width is a default, though the source says something
};

struct GeoMap {
  map::Source source = map::Source::kSurveyed;
  std::string attribution;
  std::uint32_t date_s = 0;           // since 1970, UTC; 0: not known
  std::optional<GeoExtent> bounds{};  // within which it is complete, if the source says so
  GeoExtent box{};                    // of all its points
  std::vector<GeoArea> areas{};
  std::vector<GeoRoad> roads{};
  Census census{};
  std::uint32_t datum_error_mm = 0;  // accuracy of the conversion to WGS 84
  std::string remark{};              // remarks on how it was read, in lines
};

}  // namespace iog::tools
