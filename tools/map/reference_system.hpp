// What the numbers of a map mean: its coordinate reference system, and the way from there to
// latitude and longitude of WGS 84, by PROJ and its database.
#pragma once

#include <string>

#include "tools/map/geo_map.hpp"

namespace iog::tools {

// No way to WGS 84 that is stated to be worse than this is taken.
inline constexpr double kMostDatumErrorM = 1;

// The areas of the map hold coordinates as the file has them: x, such as longitude or east, as
// `longitude`, and y as `latitude`, whatever order the system's definition names. Makes them
// degrees of WGS 84 and the map's box theirs; what is not on earth is refused, by its id. Heights
// are ignored. system: WKT, PROJ's text, or a name such as EPSG:2154; empty: WGS 84.
//
// UsageError if the system is not known, not one of the ground, or known too inexactly where the
// map is.
void to_wgs84(const std::string& system, GeoMap& map);

}  // namespace iog::tools
