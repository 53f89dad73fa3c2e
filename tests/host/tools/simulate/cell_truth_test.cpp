// The truth of cells against geometry by brute force: polygons by their corners instead of turned
// coordinates.
#include "tools/simulate/truth/cell_truth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <utility>

#include "gtest/gtest.h"

#include "tools/simulate/scenes/scene_catalogue.hpp"
#include "tools/simulate/scenes/street.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

const description::Description& description() { return *find_vehicle("reference_car").description; }

constexpr Course kStraight{.swings = {{{0, 100}, {0, 100}}}};
constexpr Cruise kCreep{
    .mean_speed = 0.001, .speed_swing = 0, .swing_period = 10, .left = 0, .weave = 0};

// On a straight road along x that begins at station 0: what the cells of a small world hold.
Scene small_world() {
  Landscape landscape;
  std::vector<Solid> solids{box(Material::kWall, {.x = 5.05, .y = 5.05}, 0.3, 0.5, 0, 3),
                            box(Material::kKerb, {.x = 9, .y = 5}, 1, 1, 0, 0.12),
                            cylinder(Material::kFoliage, 12, 5, 1, 2.4, 6)};
  landscape.place(5, solids);
  add_person(14, 5, solids);
  landscape.place(5, solids);
  landscape.sort();
  Traffic traffic;
  traffic.cars.push_back({.station = 10, .left = -3, .speed = 7.5, .shape = CarShape{}});
  return {Road(kStraight, 0, 300), kCreep, std::move(landscape), std::move(traffic)};
}

const TrueCell& cell_at(const std::vector<TrueCell>& cells, const CellArea& area, std::int32_t x,
                        std::int32_t y) {
  return cells[static_cast<std::size_t>(y - area.y) * static_cast<std::size_t>(area.width) +
               static_cast<std::size_t>(x - area.x)];
}

TEST(CellTruth, SaysWhatIsThere) {
  const CellArea area{-20, -60, 300, 150};
  const std::vector<TrueCell> cells = true_cells(small_world(), 2, area, description());
  // Centres at 4.95 ... 5.15 and 4.85 ... 5.25.
  std::map<TrueClass, int> counts;
  for (const TrueCell& cell : cells) {
    ++counts[cell.what];
  }
  EXPECT_EQ(counts[TrueClass::kInfrastructure], 3 * 5);
  EXPECT_EQ(cell_at(cells, area, 49, 48).what, TrueClass::kInfrastructure);
  EXPECT_EQ(cell_at(cells, area, 51, 52).what, TrueClass::kInfrastructure);
  EXPECT_EQ(cell_at(cells, area, 52, 50), TrueCell{});
  EXPECT_EQ(cell_at(cells, area, 90, 50), TrueCell{});   // the kerb is below the height band
  EXPECT_EQ(cell_at(cells, area, 120, 50), TrueCell{});  // the leaves are above it
  EXPECT_EQ(cell_at(cells, area, 140, 50).what, TrueClass::kMovable);
  EXPECT_EQ(cell_at(cells, area, 140, 50).speed_mm_s, 0U);
  // The car has gone 15 m from x = 10; it is 4.2 m by 1.75 m.
  EXPECT_EQ(cell_at(cells, area, 250, -30), (TrueCell{TrueClass::kMoving, kFirstMover, 7500}));
  EXPECT_EQ(counts[TrueClass::kMoving], 42 * 18);
}

TEST(CellTruth, TheClassesAloneAreThoseOfTheCells) {
  const Scene scene = find_scene("street").make(1, 20);
  const CellArea area = cells_around(scene.ego_at(12));
  std::vector<TrueClass> expected;
  for (const TrueCell& cell : true_cells(scene, 12, area, description())) {
    expected.push_back(cell.what);
  }
  EXPECT_GT(std::ranges::count(expected, TrueClass::kMoving), 0);
  EXPECT_EQ(true_classes(scene, 12, area, description()), expected);
}

// A solid, how fast it is, and the corners of its outline.
struct Drawn {
  Solid solid;
  double speed = 0;
  std::array<std::array<double, 2>, 4> corners{};

  // Whether a point lies left of every edge.
  [[nodiscard]] bool holds(double x, double y) const {
    const double away = std::hypot(x - solid.at.x, y - solid.at.y);
    if (solid.form == Solid::Form::kCylinder) {
      return away <= solid.half_length;
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& a = corners[i];
      const auto& b = corners[(i + 1) % 4];
      if ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) < 0) {
        return false;
      }
    }
    return true;
  }
};

Drawn drawn(const Solid& solid, double speed) {
  Drawn result{solid, speed, {}};
  const double angle = std::atan2(solid.at.sin, solid.at.cos);
  const double diagonal = std::hypot(solid.half_length, solid.half_width);
  const double opening = std::atan2(solid.half_width, solid.half_length);
  const double pi = std::acos(-1.0);
  const std::array directions{opening, pi - opening, pi + opening, -opening};
  for (std::size_t i = 0; i < 4; ++i) {
    result.corners[i] = {solid.at.x + diagonal * std::cos(angle + directions[i]),
                         solid.at.y + diagonal * std::sin(angle + directions[i])};
  }
  return result;
}

// What the height band meets at that time. A thing's speed is that of its first solid, from where
// it is 10 ms later.
std::vector<Drawn> drawn_at(const Scene& scene, double time_s) {
  std::vector<Solid> now;
  std::vector<Solid> next;
  std::map<std::uint32_t, double> speeds;
  std::map<std::uint32_t, Placement> later;
  scene.append_seen_at(time_s, now);
  scene.append_seen_at(time_s + 0.01, next);
  for (const Solid& solid : next) {
    later.emplace(solid.thing, solid.at);
  }
  std::vector<Drawn> result;
  for (const Solid& solid : now) {
    const auto to = later.find(solid.thing);
    if (to != later.end()) {
      const double way = std::hypot(to->second.x - solid.at.x, to->second.y - solid.at.y);
      const double speed = speeds.emplace(solid.thing, way / 0.01).first->second;
      if (solid.z_low <= 2.2 && solid.z_high >= 0.2) {
        result.push_back(drawn(solid, speed));
      }
    }
  }
  return result;
}

int rank(const Solid& solid, double speed) {
  if (solid.material != Material::kCar && solid.material != Material::kPerson) {
    return 1;
  }
  return speed > 0.05 ? 3 : 2;
}

// Cells of the street's truth, from the solids at three times, without the library's drawing.
TEST(CellTruth, AgreesWithBruteForce) {
  constexpr std::array kRanks{0, 3, 2, 1};  // of TrueClass
  const Scene scene = make_street(2, 30);
  for (const double time_s : {8.3, 13.5, 16.2}) {
    const std::vector<Drawn> solids = drawn_at(scene, time_s);
    const CellArea around = cells_around(scene.ego_at(time_s));
    const CellArea area{around.x + 512, around.y + 312, 400, 400};
    const std::vector<TrueCell> cells = true_cells(scene, time_s, area, description());
    std::size_t checked = 0;
    for (std::int32_t y = area.y; y < area.y + area.height; y += 3) {
      for (std::int32_t x = area.x; x < area.x + area.width; x += 4) {
        int best = 0;
        double speed = 0;
        for (const Drawn& each : solids) {
          const int its_rank = rank(each.solid, each.speed);
          if (its_rank > best && each.holds(x * 0.1 + 0.05, y * 0.1 + 0.05)) {
            best = its_rank;
            speed = each.speed;
          }
        }
        const TrueCell& cell = cell_at(cells, area, x, y);
        ASSERT_EQ(kRanks[static_cast<std::size_t>(cell.what)], best) << x << ", " << y;
        ASSERT_NEAR(cell.speed_mm_s / 1000.0, best > 1 ? speed : 0, 0.06);
        checked += best > 0 ? 1U : 0U;
      }
    }
    EXPECT_GT(checked, 500U);
  }
}

TEST(CellTruth, TheCarIsInTheMiddleOfItsCells) {
  EgoPose ego;
  ego.at.x = -0.01;
  ego.at.y = 123.45;
  const CellArea area = cells_around(ego);
  EXPECT_EQ(area.x + 512, -1);
  EXPECT_EQ(area.y + 512, 1234);
  EXPECT_EQ(area.width, 1024);
  EXPECT_EQ(area.height, 1024);
}

TEST(CellTruth, TheFileNamesEveryCellThatIsNotFree) {
  const std::string path = testing::TempDir() + "cell_truth_test.csv";
  const CellArea area{-20, -60, 300, 150};
  const std::vector<TrueCell> cells = true_cells(small_world(), 2, area, description());
  CellTruthFile file(path);
  file.write(3, 1'714'564'802'000'000U, area, cells);
  file.finish();
  const std::vector<std::string> lines = read_lines(path);
  std::filesystem::remove(path);
  ASSERT_EQ(lines.front(), "frame,time_us,y,x,cells,class,thing,speed_mm_s");
  EXPECT_EQ(lines[1], "3,1714564802000000,-39,229,42,moving,1000000,7500");
  EXPECT_NE(std::ranges::find(lines, "3,1714564802000000,50,49,3,infrastructure,1,0"), lines.end());
  std::size_t count = 0;
  for (const std::string& line : std::span(lines).subspan(1)) {
    std::size_t begin = 0;
    for (int comma = 0; comma < 4; ++comma) {
      begin = line.find(',', begin) + 1;
    }
    count += static_cast<std::size_t>(std::stoi(line.substr(begin)));
  }
  const auto free = std::ranges::count(cells, TrueClass::kFree, &TrueCell::what);
  EXPECT_EQ(count, cells.size() - static_cast<std::size_t>(free));
}

// Of the car ahead in its lane: 9 m/s on average, as the car itself, and its distance swings.
TEST(CellTruth, ACarThatKeepsAheadIsAsFastAsTheCar) {
  const Scene scene = find_scene("city").make(31, 12);
  for (const double time_s : {2.0, 5.0, 8.0, 11.0}) {
    const double ego_mps =
        scene.cruise.station_at(time_s + 0.5) - scene.cruise.station_at(time_s - 0.5);
    const CellArea area = cells_around(scene.ego_at(time_s));
    std::size_t count = 0;
    for (const TrueCell& cell : true_cells(scene, time_s, area, description())) {
      if (cell.thing == kFirstMover) {
        EXPECT_EQ(cell.what, TrueClass::kMoving);
        EXPECT_NEAR(cell.speed_mm_s / 1000.0, ego_mps, 2.2) << time_s;
        ++count;
      }
    }
    EXPECT_GT(count, 100U) << time_s;
  }
}

}  // namespace
}  // namespace iog::tools
