// Where maps come from. UsageError from each if the file cannot be read or is not of its format;
// single objects that are of no use are counted in the map's census.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "tools/map/geo_map.hpp"

namespace iog::tools {

// OpenStreetMap, XML or PBF, plain or compressed. `formats` are those that its user reads.
[[nodiscard]] GeoMap read_osm(
    const std::string& path,
    const std::string& formats = ".osm, .osm.pbf, .osm.gz and .osm.bz2, of OpenStreetMap");

// Polygons and MultiPolygons of GeoJSON (RFC 7946), of any coordinate reference system that PROJ
// can lead to WGS 84 (reference_system.hpp). A feature's property "kind" ("building" or
// "road") goes before `kind`.
[[nodiscard]] GeoMap read_geojson(const std::string& path, std::optional<map::Kind> kind);

// Polygons of an ESRI Shapefile, likewise, all of one kind.
[[nodiscard]] GeoMap read_shapefile(const std::string& path, std::optional<map::Kind> kind);

// By the end of its name.
[[nodiscard]] GeoMap read_map(const std::string& path, std::optional<map::Kind> kind);

// Returns true if two sides of an outline cross, so its inside is undefined. Touching does not
// count. The last point must not repeat the first.
[[nodiscard]] bool crosses_itself(std::span<const GeoPoint> ring);
// As the census calls such an area.
inline constexpr const char* kCrossesItself = "area whose outline crosses itself";

// What the census calls areas of a kind.
[[nodiscard]] const char* census_name(map::Kind kind);

// "building" or "road"; empty for any other word.
[[nodiscard]] std::optional<map::Kind> kind_of_word(const std::string& word);

}  // namespace iog::tools
