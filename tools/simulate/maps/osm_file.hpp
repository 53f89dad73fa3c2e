// A drawn map as OpenStreetMap XML (API 0.6), as editors and converters read it.
//
// Houses are closed ways with building=yes, roads are ways with highway, lanes, width and oneway.
// Coordinates have seven decimals, as OpenStreetMap keeps them: 1.1 cm. Ids count from 1; nodes
// come before ways. What was drawn wrongly has a tag iogrid:error, and a comment at the top says
// how many; a file asks editors never to upload it.
#pragma once

#include <string>
#include <string_view>

#include "tools/simulate/maps/drawn_map.hpp"
#include "tools/simulate/world/map_place.hpp"

namespace iog::tools {

// The same map and place make the same text on every machine. scene: its name, for the comment.
[[nodiscard]] std::string osm_text(const DrawnMap& map, const MapPlace& place,
                                   std::string_view scene);

// What was drawn, and how wrongly, in one line.
[[nodiscard]] std::string summary_of(const DrawnMap& map);

}  // namespace iog::tools
