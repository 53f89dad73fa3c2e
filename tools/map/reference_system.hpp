// A map's coordinate reference system, and PROJ's operation from it to latitude and longitude of
// WGS 84.
#pragma once

#include <string>

#include "tools/map/geo_map.hpp"

namespace iog::tools {

// An operation whose stated accuracy is worse than this is refused.
inline constexpr double kMostDatumErrorM = 1;

// The areas of the map hold coordinates as the file has them: x, such as longitude or east, as
// `longitude`, and y as `latitude`, whatever order the system's definition names. Converts them and
// the map's box to degrees of WGS 84. Areas that are not on earth are refused by their id. Heights
// are ignored. system: WKT, PROJ's text, or a name such as EPSG:2154; empty: WGS 84.
//
// UsageError if the system is unknown, not horizontal, or not accurate enough where the map is.
void to_wgs84(const std::string& system, GeoMap& map);

}  // namespace iog::tools
