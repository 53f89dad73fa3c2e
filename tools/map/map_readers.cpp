#include "tools/map/map_readers.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "tools/program/exit_status.hpp"

namespace iog::tools {

GeoMap read_map(const std::string& path, std::optional<map::Kind> kind) {
  if (std::filesystem::is_directory(path)) {
    throw UsageError(path + ": cannot be read: it is a folder");
  }
  if (path.ends_with(".geojson") || path.ends_with(".json")) {
    return read_geojson(path, kind);
  }
  if (path.ends_with(".shp")) {
    return read_shapefile(path, kind);
  }
  if (kind) {
    throw UsageError(
        "--kind is for GeoJSON and Shapefiles; OpenStreetMap says itself what is what");
  }
  return read_osm(path, ".osm, .osm.pbf, .osm.gz, .osm.bz2, .geojson and .shp");
}

bool crosses_itself(std::span<const GeoPoint> ring) {
  struct Side {
    GeoPoint from;
    GeoPoint to;
    [[nodiscard]] double west() const { return std::min(from.longitude, to.longitude); }
    [[nodiscard]] double east() const { return std::max(from.longitude, to.longitude); }
    // Positive if the point is left of this side's line, negative if right, 0 on it.
    [[nodiscard]] double side_of(const GeoPoint& point) const {
      return (to.longitude - from.longitude) * (point.latitude - from.latitude) -
             (to.latitude - from.latitude) * (point.longitude - from.longitude);
    }
    [[nodiscard]] bool parts(const Side& other) const {
      return side_of(other.from) * side_of(other.to) < 0;
    }
  };
  std::vector<Side> sides;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    sides.push_back({ring[i], ring[(i + 1) % ring.size()]});
  }
  std::ranges::sort(sides, {}, &Side::west);
  for (auto its = sides.begin(); its != sides.end(); ++its) {
    for (auto other = its + 1; other != sides.end() && other->west() < its->east(); ++other) {
      if (its->parts(*other) && other->parts(*its)) {
        return true;
      }
    }
  }
  return false;
}

std::optional<map::Kind> kind_of_word(const std::string& word) {
  if (word == "building") {
    return map::Kind::kBuilding;
  }
  return word == "road" ? std::optional(map::Kind::kRoad) : std::nullopt;
}

const char* census_name(map::Kind kind) {
  return kind == map::Kind::kRoad ? "areas of roads" : "buildings";
}

}  // namespace iog::tools
