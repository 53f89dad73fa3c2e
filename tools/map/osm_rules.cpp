#include "tools/map/osm_rules.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>

namespace iog::tools::osm {
namespace {

constexpr double kFootM = 0.3048;
constexpr double kInchM = 0.0254;
constexpr double kLaneM = 3.25;
constexpr double kMinWidthM = 1.5;
constexpr double kMaxWidthM = 60;
constexpr double kMaxLanes = 20;

struct RoadKind {
  std::string_view name;
  double width_m;
};

// Where neither its width nor its lanes are known.
constexpr std::array<RoadKind, 16> kRoads{{{"motorway", 11},
                                           {"trunk", 11},
                                           {"primary", 9},
                                           {"secondary", 8},
                                           {"tertiary", 7},
                                           {"unclassified", 7},
                                           {"residential", 6.5},
                                           {"living_street", 6},
                                           {"service", 4},
                                           {"motorway_link", 6},
                                           {"trunk_link", 6},
                                           {"primary_link", 5},
                                           {"secondary_link", 5},
                                           {"tertiary_link", 5},
                                           {"busway", 6.5},
                                           {"road", 6.5}}};

// What stands before a value, or is one, of things that are not there: yet, or any more.
constexpr std::array<std::string_view, 8> kNotThere{
    "no", "proposed", "planned", "construction", "abandoned", "disused", "razed", "demolished"};

// A roof stands on posts: lidars look below it.
constexpr std::array<std::string_view, 4> kRoofs{"roof", "carport", "canopy", "grandstand_roof"};

std::string_view value_of(const osmium::TagList& tags, const char* key) {
  const char* const value = tags.get_value_by_key(key);
  return value != nullptr ? value : "";
}

template <std::size_t kCount>
bool is_one_of(std::string_view value, const std::array<std::string_view, kCount>& values) {
  return std::ranges::find(values, value) != values.end();
}

bool is_yes(std::string_view value) { return !value.empty() && value != "no"; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') {
    text.remove_prefix(1);
  }
  while (!text.empty() && text.back() == ' ') {
    text.remove_suffix(1);
  }
  return text;
}

// A number at the beginning of a text, which is left behind it. The decimal sign may be a comma.
std::optional<double> take_number(std::string_view& text) {
  text = trimmed(text);
  std::size_t length = 0;
  while (length < text.size() && (std::isdigit(static_cast<unsigned char>(text[length])) != 0 ||
                                  text[length] == '.' || text[length] == ',')) {
    ++length;
  }
  std::string digits(text.substr(0, length));
  std::ranges::replace(digits, ',', '.');
  double number = 0;
  const auto end = digits.data() + digits.size();
  const auto result = std::from_chars(digits.data(), end, number);
  if (result.ec != std::errc() || result.ptr != end) {
    return std::nullopt;
  }
  text = trimmed(text.substr(length));
  return number;
}

std::optional<double> number_of(std::string_view text) {
  const std::optional<double> number = take_number(text);
  return text.empty() ? number : std::nullopt;
}

const RoadKind* kind_of(std::string_view highway) {
  const auto* const found = std::ranges::find(kRoads, highway, &RoadKind::name);
  return found != kRoads.end() ? found : nullptr;
}

// Not at the height of the road: where a lidar of the road does not look.
const char* why_not_on_the_ground(const osmium::TagList& tags) {
  if (value_of(tags, "location") == "underground" || is_yes(value_of(tags, "indoor"))) {
    return "below ground or indoors";
  }
  if (number_of(value_of(tags, "building:min_level")).value_or(0) > 0 ||
      number_of(value_of(tags, "min_level")).value_or(0) > 0 ||
      metres_of(value_of(tags, "min_height")).value_or(0) > 0) {
    return "above the ground";
  }
  return nullptr;
}

Ruling building_ruling(const osmium::TagList& tags, std::string_view building) {
  if (building == "construction") {
    return {Taking::kBuilding};
  }
  if (is_one_of(building, kNotThere)) {
    return {Taking::kRefused, "building that is not there"};
  }
  if (is_one_of(building, kRoofs) || value_of(tags, "wall") == "no") {
    return {Taking::kRefused, "roof without walls"};
  }
  if (const char* const why = why_not_on_the_ground(tags)) {
    return {Taking::kRefused, std::string_view(why).starts_with("above")
                                  ? "building above the ground"
                                  : "building below ground or indoors"};
  }
  // "-1" and below: `layer` of what is under the ground.
  if (value_of(tags, "layer").starts_with('-')) {
    return {Taking::kRefused, "building below ground or indoors"};
  }
  return {Taking::kBuilding};
}

// `highway` names a kind of road.
Ruling road_ruling(const osmium::TagList& tags, Taking taking) {
  const std::string_view tunnel = value_of(tags, "tunnel");
  if (is_yes(tunnel) && tunnel != "building_passage") {
    return {Taking::kRefused, "road in a tunnel"};
  }
  if (why_not_on_the_ground(tags) != nullptr) {
    return {Taking::kRefused, "road indoors or off the ground"};
  }
  return {taking};
}

}  // namespace

std::optional<double> metres_of(std::string_view text) {
  std::optional<double> number = take_number(text);
  if (!number || text.empty() || text == "m" || text == "metre" || text == "metres") {
    return number;
  }
  if (text == "ft" || text == "feet") {
    return *number * kFootM;
  }
  if (!text.starts_with('\'')) {
    return std::nullopt;
  }
  text.remove_prefix(1);
  if (trimmed(text).empty()) {
    return *number * kFootM;
  }
  const std::optional<double> inches = take_number(text);
  return inches && text == "\"" ? std::optional(*number * kFootM + *inches * kInchM) : std::nullopt;
}

Ruling area_ruling(const osmium::TagList& tags) {
  if (const std::string_view building = value_of(tags, "building"); !building.empty()) {
    return building_ruling(tags, building);
  }
  if (is_yes(value_of(tags, "building:part"))) {
    return {Taking::kRefused, "part of a building, whose outline counts"};
  }
  if (kind_of(value_of(tags, "area:highway")) != nullptr) {
    return road_ruling(tags, Taking::kRoadArea);
  }
  if (value_of(tags, "area") == "yes" && kind_of(value_of(tags, "highway")) != nullptr) {
    return road_ruling(tags, Taking::kRoadArea);
  }
  return {};
}

Ruling line_ruling(const osmium::TagList& tags) {
  const std::string_view highway = value_of(tags, "highway");
  if (highway.empty() || value_of(tags, "area") == "yes") {
    return {};
  }
  if (is_one_of(highway, kNotThere)) {
    return {Taking::kRefused, "road that is not there"};
  }
  if (kind_of(highway) == nullptr) {
    return {Taking::kRefused, "way that is not for cars"};
  }
  return road_ruling(tags, Taking::kRoadLine);
}

Width width_of(const osmium::TagList& tags) {
  Width width;
  if (const std::string_view text = value_of(tags, "width"); !text.empty()) {
    const std::optional<double> metres = metres_of(text);
    if (metres && *metres >= kMinWidthM && *metres <= kMaxWidthM) {
      return {*metres, "roads, width by their width", ""};
    }
    width.remark = metres ? "width that cannot be" : "width that cannot be read";
  }
  if (const std::string_view text = value_of(tags, "lanes"); !text.empty()) {
    const std::optional<double> lanes = number_of(text);
    if (lanes && *lanes >= 1 && *lanes <= kMaxLanes) {
      return {*lanes * kLaneM, "roads, width by their lanes", width.remark};
    }
    width.remark = "lanes that cannot be read";
  }
  const RoadKind* const kind = kind_of(value_of(tags, "highway"));
  width.metres = kind != nullptr ? kind->width_m : 0;
  width.from = "roads, width by their kind";
  return width;
}

}  // namespace iog::tools::osm
