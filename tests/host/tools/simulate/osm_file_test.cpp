// The map of a scene, read back by a reader of the test's own. Where the houses and roads of the
// file are is found by the plane and the transform that the poses carry, and compared with the
// scene.
#include "tools/simulate/maps/osm_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "gtest/gtest.h"

#include "tools/simulate/scenes/scene_catalogue.hpp"

namespace iog::tools {
namespace {

constexpr double kDriveS = 10;
// OpenStreetMap's decimals: half of 1.1 cm on each axis.
constexpr double kResolutionM = 0.008;

struct Point {
  double x = 0;
  double y = 0;
};

struct Way {
  std::vector<long> nodes;
  std::map<std::string, std::string> tags;
};

struct Osm {
  std::map<long, Geodetic> nodes;
  std::vector<Way> ways;
  std::vector<std::string> faults;
};

// The value of an attribute of an element that stands on one line.
std::string attribute_of(const std::string& line, const std::string& name) {
  const std::string key = ' ' + name + "=\"";
  const std::size_t at = line.find(key);
  if (at == std::string::npos) {
    return "";
  }
  const std::size_t from = at + key.size();
  return line.substr(from, line.find('"', from) - from);
}

double number_of(const std::string& line, const std::string& name) {
  return std::strtod(attribute_of(line, name).c_str(), nullptr);
}

// Ids rise, and every node that is named is there before its way.
Osm parsed(const std::string& text) {
  Osm osm;
  std::istringstream lines(text);
  long last_id = 0;
  for (std::string line; std::getline(lines, line);) {
    const long id = static_cast<long>(number_of(line, "id"));
    if (line.starts_with("  <node ")) {
      osm.nodes[id] = {number_of(line, "lat"), number_of(line, "lon")};
    } else if (line.starts_with("  <way ")) {
      last_id = osm.ways.empty() ? 0 : last_id;
      osm.ways.emplace_back();
    } else if (line.starts_with("    <nd ")) {
      osm.ways.back().nodes.push_back(static_cast<long>(number_of(line, "ref")));
      if (!osm.nodes.contains(osm.ways.back().nodes.back())) {
        osm.faults.push_back(line);
      }
    } else if (line.starts_with("    <tag ")) {
      osm.ways.back().tags[attribute_of(line, "k")] = attribute_of(line, "v");
    }
    if (id != 0 && id != ++last_id) {
      osm.faults.push_back(line);
    }
  }
  return osm;
}

// Where a point of the file is in the local frame, by what a target is told: the plane of the
// origin, and the transform of the messages.
class ToLocalFrame {
 public:
  explicit ToLocalFrame(const MapPlace& place)
      : plane_(place.origin.plane()), transform_(place.transform()) {}

  [[nodiscard]] Point of(const Geodetic& at) const {
    const LocalPlane::Place place = plane_.place_of(at.latitude, at.longitude);
    const double x = place.east_m - transform_.local_frame.x_mm / 1000.0;
    const double y = place.north_m - transform_.local_frame.y_mm / 1000.0;
    const double heading = transform_.local_frame.heading / 0x1p32 * 2 * std::acos(-1.0);
    return {x * std::cos(heading) + y * std::sin(heading),
            y * std::cos(heading) - x * std::sin(heading)};
  }

 private:
  LocalPlane plane_;
  pose::MapTransform transform_;
};

Osm osm_of(const Scene& scene, const MapErrors& errors = {}, const MapPlace& place = {}) {
  return parsed(osm_text(drawn_map(scene, errors, 1, kDriveS), place, "test"));
}

class OsmOfEveryScene : public testing::TestWithParam<SceneEntry> {
 protected:
  Scene scene_ = GetParam().make(1, kDriveS);
};

INSTANTIATE_TEST_SUITE_P(Scenes, OsmOfEveryScene, testing::ValuesIn(all_scenes()),
                         [](const auto& entry) { return std::string(entry.param.name); });

TEST_P(OsmOfEveryScene, HasEveryHouseAndEveryRoadOnce) {
  const Osm osm = osm_of(scene_);
  EXPECT_TRUE(osm.faults.empty()) << osm.faults.front();
  std::size_t houses = 0;
  for (const Way& way : osm.ways) {
    const bool is_house = way.tags.contains("building");
    houses += is_house ? 1U : 0U;
    EXPECT_EQ(way.nodes.size() == 5 && way.nodes.front() == way.nodes.back(), is_house);
    EXPECT_NE(way.tags.contains("highway"), is_house);
    EXPECT_EQ(way.tags.contains("width"), !is_house);
    EXPECT_FALSE(way.tags.contains("iogrid:error"));
  }
  EXPECT_GT(houses, 20U);
  EXPECT_EQ(houses, scene_.plan.houses.size());
  EXPECT_EQ(osm.ways.size() - houses, scene_.plan.roads.size());
}

// The corners of the solids that the scanners see are in the file.
TEST_P(OsmOfEveryScene, HousesAreWhereTheScannersSeeThem) {
  for (const MapPlace& place :
       {MapPlace{}, MapPlace{.origin = {49'000'000'000, 8'400'000'000}, .local_frame = {}}}) {
    const Osm osm = osm_of(scene_, {}, place);
    const ToLocalFrame to_local(place);
    std::vector<Point> corners;
    for (const Way& way : osm.ways) {
      for (const long node : way.nodes) {
        if (way.tags.contains("building")) {
          corners.push_back(to_local.of(osm.nodes.at(node)));
        }
      }
    }
    std::vector<Solid> solids;
    scene_.append_seen_at(kDriveS / 2, solids);
    std::size_t walls = 0;
    for (const Solid& solid : solids) {
      // A noise barrier is thin and no house.
      if (solid.material != Material::kWall || solid.half_width < 1) {
        continue;
      }
      ++walls;
      const Placement corner = moved(solid.at, solid.half_length, -solid.half_width);
      EXPECT_TRUE(std::ranges::any_of(corners, [&corner](const Point& at) {
        return std::hypot(at.x - corner.x, at.y - corner.y) < kResolutionM;
      }));
    }
    EXPECT_GT(walls, 10U);
  }
}

// The car is always within the width of a road: of one of its pieces, seen from the side.
TEST_P(OsmOfEveryScene, TheCarDrivesOnARoad) {
  const Osm osm = osm_of(scene_);
  const ToLocalFrame to_local{MapPlace{}};
  for (double time_s = 0; time_s <= kDriveS; time_s += 0.5) {
    const Placement car = scene_.ego_at(time_s).at;
    double room = -1;
    for (const Way& way : osm.ways) {
      for (std::size_t i = 1; way.tags.contains("highway") && i < way.nodes.size(); ++i) {
        const Point a = to_local.of(osm.nodes.at(way.nodes[i - 1]));
        const Point b = to_local.of(osm.nodes.at(way.nodes[i]));
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        const double along = ((car.x - a.x) * (b.x - a.x) + (car.y - a.y) * (b.y - a.y)) / length;
        const double beside = ((b.x - a.x) * (car.y - a.y) - (b.y - a.y) * (car.x - a.x)) / length;
        if (along >= -0.1 && along <= length + 0.1) {
          room = std::max(room, std::stod(way.tags.at("width")) / 2 - std::abs(beside));
        }
      }
    }
    EXPECT_GT(room, 2.0) << time_s;
  }
}

// A way begins where another one ends or passes: nobody has to jump.
TEST_P(OsmOfEveryScene, RoadsShareTheirNodes) {
  const Osm osm = osm_of(scene_);
  std::map<long, int> ways_of;
  std::set<std::pair<double, double>> places;
  for (const Way& way : osm.ways) {
    if (way.tags.contains("highway")) {
      for (const long node : std::set<long>(way.nodes.begin(), way.nodes.end())) {
        const Geodetic at = osm.nodes.at(node);
        EXPECT_EQ(ways_of[node]++ == 0, places.insert({at.latitude, at.longitude}).second);
      }
    }
  }
  for (const Way& way : osm.ways) {
    if (way.tags.contains("highway")) {
      EXPECT_GT(ways_of[way.nodes.front()] + ways_of[way.nodes.back()], 2);
    }
  }
}

TEST_P(OsmOfEveryScene, TheShiftIsThatOfThePlane) {
  const Osm right = osm_of(scene_);
  const Osm wrong = osm_of(scene_, {.shift_east_m = 0.5, .shift_north_m = -2});
  const LocalPlane plane = MapPlace{}.origin.plane();
  ASSERT_EQ(right.nodes.size(), wrong.nodes.size());
  for (const auto& [id, at] : right.nodes) {
    const LocalPlane::Place a = plane.place_of(at.latitude, at.longitude);
    const Geodetic moved_to = wrong.nodes.at(id);
    const LocalPlane::Place b = plane.place_of(moved_to.latitude, moved_to.longitude);
    EXPECT_NEAR(b.east_m - a.east_m, 0.5, 2 * kResolutionM);
    EXPECT_NEAR(b.north_m - a.north_m, -2, 2 * kResolutionM);
  }
}

TEST(OsmFile, SaysWhatIsWrongWithIt) {
  const Scene scene = find_scene("city").make(1, kDriveS);
  const MapErrors errors{.missing = 0.1, .ghosts = 3, .outdated = 0.1, .no_width = 0.5};
  const DrawnMap map = drawn_map(scene, errors, 7, kDriveS);
  const std::string text = osm_text(map, MapPlace{}, "city");
  std::map<std::string, std::size_t> wrong;
  for (const Way& way : parsed(text).ways) {
    const auto error = way.tags.find("iogrid:error");
    if (error != way.tags.end()) {
      ++wrong[error->second];
      EXPECT_FALSE(way.tags.contains("width"));
    }
  }
  EXPECT_EQ(wrong["ghost beside a road"], 2U);
  EXPECT_EQ(wrong["ghost on a road"], 1U);
  EXPECT_EQ(wrong["outdated"], std::lround(0.1 * static_cast<double>(map.houses.size() - 3)));
  EXPECT_EQ(wrong["no width"], std::lround(0.5 * static_cast<double>(map.roads.size())));
  EXPECT_EQ(wrong.size(), 4U);
  const std::string comment = text.substr(text.find("<!--") + 4, text.find("-->") - 4);
  EXPECT_EQ(comment.substr(0, comment.find("-->")).find("--"), std::string::npos);
  EXPECT_NE(text.find(std::to_string(map.missing.size()) + " houses missing"), std::string::npos);
  EXPECT_NE(text.find(text_of(MapPlace{}.origin)), std::string::npos);
  EXPECT_NE(text.find("upload=\"never\""), std::string::npos);
}

TEST(OsmFile, IsTheSameTextAgain) {
  const auto text = [](std::uint64_t seed) {
    const Scene scene = find_scene("city").make(3, kDriveS);
    return osm_text(drawn_map(scene, {.noise_m = 1, .ghosts = 2}, seed, kDriveS), {}, "city");
  };
  EXPECT_EQ(text(5), text(5));
  EXPECT_NE(text(5), text(6));
}

}  // namespace
}  // namespace iog::tools
