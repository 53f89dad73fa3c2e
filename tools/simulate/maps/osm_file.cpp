#include "tools/simulate/maps/osm_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "numeric/elementary.hpp"
#include "tools/program/fixed.hpp"

namespace iog::tools {
namespace {

constexpr int kDecimals = 7;

// 1e-7 degrees.
struct OsmPoint {
  std::int64_t latitude;
  std::int64_t longitude;
  friend bool operator<(const OsmPoint& a, const OsmPoint& b) {
    return a.latitude != b.latitude ? a.latitude < b.latitude : a.longitude < b.longitude;
  }
};

std::string attribute(std::string_view name, std::string_view value) {
  return ' ' + std::string(name) + "=\"" + std::string(value) + '"';
}

std::string tag(std::string_view key, std::string_view value) {
  return "    <tag" + attribute("k", key) + attribute("v", value) + "/>\n";
}

std::string position(const OsmPoint& at, std::string_view prefix = "") {
  const std::string name(prefix);
  return attribute(name + "lat", decimal_degrees(at.latitude, kDecimals)) +
         attribute(name + "lon", decimal_degrees(at.longitude, kDecimals));
}

std::size_t count_of(const DrawnMap& map, HouseDrawn how) {
  return static_cast<std::size_t>(std::ranges::count(map.houses, how, &DrawnHouse::how));
}

class OsmText {
 public:
  OsmText(const MapPlace& place, const MapErrors& errors)
      : to_plane_(place), plane_(place.origin.plane()), errors_(&errors) {}

  // Roads that meet share the node of their end.
  void add(const DrawnRoad& drawn) {
    const PlannedRoad& road = drawn.road;
    std::vector<std::size_t> nodes;
    for (const Placement& at : road.line) {
      const OsmPoint point = point_of(at.x, at.y);
      const auto [known, is_new] = road_nodes_.try_emplace(point, points_.size() + 1);
      if (is_new) {
        points_.push_back(point);
      }
      nodes.push_back(known->second);
    }
    std::string tags = tag("highway", road.kind) + tag("lanes", std::to_string(road.lanes));
    tags += road.is_oneway ? tag("oneway", "yes") : "";
    tags +=
        drawn.has_width ? tag("width", fixed(road.width_m, 2)) : tag("iogrid:error", "no width");
    add_way(nodes, tags);
  }

  void add(const DrawnHouse& drawn) {
    constexpr std::array<std::string_view, 4> kErrors{"", "outdated", "ghost beside a road",
                                                      "ghost on a road"};
    const PlannedHouse& house = drawn.house;
    std::vector<std::size_t> nodes;
    for (const auto& [forward, left] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      const Placement at =
          moved(house.at, forward * house.half_length_m, left * house.half_width_m);
      points_.push_back(point_of(at.x, at.y));
      nodes.push_back(points_.size());
    }
    nodes.push_back(nodes.front());
    const std::string_view error = kErrors[static_cast<std::size_t>(drawn.how)];
    add_way(nodes, tag("building", "yes") + (error.empty() ? "" : tag("iogrid:error", error)));
  }

  [[nodiscard]] std::string text(std::string_view comment) const {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- " + std::string(comment) +
                       " -->\n<osm version=\"0.6\" generator=\"iog simulate\" upload=\"never\">\n" +
                       bounds();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      text += "  <node" + attribute("id", std::to_string(i + 1)) + attribute("version", "1") +
              position(points_[i]) + "/>\n";
    }
    return text + ways_ + "</osm>\n";
  }

 private:
  [[nodiscard]] OsmPoint point_of(double x, double y) const {
    LocalPlane::Place place = to_plane_.place_of(x, y);
    place.east_m += errors_->shift_east_m;
    place.north_m += errors_->shift_north_m;
    const Geodetic at = plane_.geodetic_of(place);
    return {numeric::round(at.latitude * 1e7), numeric::round(at.longitude * 1e7)};
  }

  void add_way(const std::vector<std::size_t>& nodes, const std::string& tags) {
    ways_ += "  <way" + attribute("id", std::to_string(++way_count_)) + attribute("version", "1") +
             ">\n";
    for (const std::size_t node : nodes) {
      ways_ += "    <nd" + attribute("ref", std::to_string(node)) + "/>\n";
    }
    ways_ += tags + "  </way>\n";
  }

  [[nodiscard]] std::string bounds() const {
    if (points_.empty()) {
      return "";
    }
    const auto [south, north] = std::ranges::minmax(points_, {}, &OsmPoint::latitude);
    const auto [west, east] = std::ranges::minmax(points_, {}, &OsmPoint::longitude);
    return "  <bounds" + position({south.latitude, west.longitude}, "min") +
           position({north.latitude, east.longitude}, "max") + "/>\n";
  }

  ToMapPlane to_plane_;
  LocalPlane plane_;
  const MapErrors* errors_;
  std::vector<OsmPoint> points_;  // of node i + 1
  std::map<OsmPoint, std::size_t> road_nodes_;
  std::string ways_;
  std::size_t way_count_ = 0;
};

}  // namespace

std::string summary_of(const DrawnMap& map) {
  const auto roads =
      static_cast<std::size_t>(std::ranges::count(map.roads, false, &DrawnRoad::has_width));
  return std::to_string(map.roads.size()) + " roads, " + std::to_string(roads) +
         " without width; " + std::to_string(map.houses.size()) + " houses, " +
         std::to_string(count_of(map, HouseDrawn::kOutdated)) + " outdated, " +
         std::to_string(count_of(map, HouseDrawn::kGhostBeside)) + " ghosts beside a road, " +
         std::to_string(count_of(map, HouseDrawn::kGhostOnRoad)) + " on one; " +
         std::to_string(map.missing.size()) + " houses missing; noise " +
         fixed(map.errors.noise_m, 2) + " m; shift " + fixed(map.errors.shift_east_m, 2) +
         " m east, " + fixed(map.errors.shift_north_m, 2) + " m north";
}

std::string osm_text(const DrawnMap& map, const MapPlace& place, std::string_view scene) {
  OsmText text(place, map.errors);
  for (const DrawnRoad& road : map.roads) {
    text.add(road);
  }
  for (const DrawnHouse& house : map.houses) {
    text.add(house);
  }
  return text.text("Simulated, no real place: scene " + std::string(scene) + ", plane at " +
                   text_of(place.origin) + ", errors of seed " + std::to_string(map.seed) + ". " +
                   summary_of(map) + ".");
}

}  // namespace iog::tools
