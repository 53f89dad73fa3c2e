// What the tags of an OpenStreetMap object make of it. The rules are those of docs/map.md.
#pragma once

#include <optional>
#include <osmium/osm/tag.hpp>
#include <string_view>

namespace iog::tools::osm {

enum class Taking {
  kNothing,   // says nothing about buildings or roads
  kBuilding,  // an area
  kRoadArea,  // an area
  kRoadLine,  // the middle of a road
  kRefused,
};

struct Ruling {
  Taking taking = Taking::kNothing;
  const char* why = "";  // of a refusal
};

// Of a closed way or a multipolygon.
[[nodiscard]] Ruling area_ruling(const osmium::TagList& tags);
// Of a way, closed or not.
[[nodiscard]] Ruling line_ruling(const osmium::TagList& tags);

struct Width {
  double metres = 0;
  const char* from = "";    // what it was taken from
  const char* remark = "";  // why a tag was not believed, if one was not
};

// Of a road, for which line_ruling() says kRoadLine.
[[nodiscard]] Width width_of(const osmium::TagList& tags);

// "3", "3.5 m", "10'", "9'6\"", "12 ft". Empty for everything else.
[[nodiscard]] std::optional<double> metres_of(std::string_view text);

}  // namespace iog::tools::osm
