#include "tools/map/map_readers.hpp"

#include <filesystem>

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
