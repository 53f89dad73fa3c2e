// Both approaches of the many-core paper, against each other and against its sentences.
#include "lab/reference/many_core.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "fakes/random.hpp"
#include "lab/reference/fusion.hpp"
#include "numeric/elementary.hpp"

namespace iog::lab::reference {
namespace {

constexpr double kDegree = numeric::kPi / 180;

// Coordinates that meet borders and centres of cells as well as anything between.
double coordinate(tests::Random& random) { return random.between(-120, 120) * 0.05; }

struct Result {
  std::vector<double> probabilities;
  Operations operations;
};

Result by_cells(const PlaneGrid& grid, std::span<const PlaneScan> scans,
                const AnalyticModel& model) {
  Result result{std::vector<double>(grid.cells(), -1.0), {}};
  result.operations = cell_by_cell(grid, scans, model, result.probabilities);
  return result;
}

Result by_beams(const PlaneGrid& grid, std::span<const PlaneScan> scans,
                const AnalyticModel& model) {
  Result result{std::vector<double>(grid.cells(), -1.0), {}};
  result.operations = beam_by_beam(grid, scans, model, kLuxStopBehindM, result.probabilities);
  return result;
}

// Fans and ranges that do not move once they are made.
struct Scene {
  std::vector<Fan> fans;
  std::vector<std::vector<double>> ranges_m;

  void add(const Fan& fan, std::vector<double> ranges) {
    fans.push_back(fan);
    ranges_m.push_back(std::move(ranges));
  }
  [[nodiscard]] std::vector<PlaneScan> scans() const {
    std::vector<PlaneScan> scans;
    for (std::size_t i = 0; i < fans.size(); ++i) {
      scans.push_back({&fans[i], ranges_m[i]});
    }
    return scans;
  }
};

// A tenth of the beams without a return; origins inside the grid and outside.
Scene random_scene(tests::Random& random) {
  Scene scene;
  for (int fan = 0; fan < 3; ++fan) {
    const auto beams = static_cast<std::size_t>(random.between(1, 60));
    const double step = random.between(1, 160) * kDegree / 60;
    std::vector<double> ranges(beams);
    for (double& range : ranges) {
      range = random.one_in(10) ? 0 : random.between(1, 1500) * 0.01;
    }
    scene.add(Fan(coordinate(random), coordinate(random), random.between(-720, 720) * kDegree / 4,
                  step, beams),
              std::move(ranges));
  }
  return scene;
}

// 'o' likely occupied, '.' likely empty, ' ' unknown; the highest y first.
std::string map_of(const PlaneGrid& grid, const std::vector<double>& probabilities) {
  std::string map;
  const auto columns = static_cast<std::size_t>(grid.columns);
  for (auto row = static_cast<std::size_t>(grid.rows); row-- > 0;) {
    for (std::size_t column = 0; column < columns; ++column) {
      const double p = probabilities[row * columns + column];
      map += p > 0.5 ? 'o' : p < 0.5 ? '.' : ' ';
    }
    map += '\n';
  }
  return map;
}

// "the field-of-views of two beams of the same lidar sensor never overlap each other", and there
// is no gap between them.
TEST(Fan, EveryPointIsSeenByTheBeamOfItsDirection) {
  tests::Random random(1);
  for (int round = 0; round < 300; ++round) {
    const auto beams = static_cast<std::size_t>(random.between(1, 200));
    const double step = random.between(1, 8) * kDegree / 10;
    const double middle = random.between(-720, 720) * kDegree / 4;
    const Fan fan(0, 0, middle, step, beams);
    for (int point = 0; point < 100; ++point) {
      const double dx = coordinate(random);
      const double dy = coordinate(random);
      std::size_t seen = 0;
      for (std::size_t beam = 0; beam < beams; ++beam) {
        seen += fan.sees(beam, dx, dy) ? 1U : 0U;
      }
      const auto found = fan.beam_of(dx, dy);
      ASSERT_EQ(seen, found ? 1U : 0U);
      if (found) {
        ASSERT_TRUE(fan.sees(*found, dx, dy));
        // Not further from the beam's direction than half a step.
        const Direction ahead = fan.direction(*found);
        const double away = std::atan2(ahead.x * dy - ahead.y * dx, ahead.x * dx + ahead.y * dy);
        ASSERT_LE(std::abs(away), step / 2 + 1e-9);
      }
    }
  }
}

// Equation 6.
TEST(ManyCore, FusionWithUnknownChangesNothing) {
  tests::Random random(2);
  for (int round = 0; round < 100'000; ++round) {
    const double p = (static_cast<double>(random.next() >> 11) + 0.5) * 0x1p-53;
    ASSERT_EQ(fuse_bayes(p, 0.5), p);
  }
}

TEST(ManyCore, TheLuxModelIsUnknownWhereABeamStops) {
  const AnalyticModel model = lux_model();
  for (int centimetres = 1; centimetres < 6000; ++centimetres) {
    const double z = centimetres * 0.01;
    ASSERT_EQ(model.probability(z + kLuxStopBehindM, z), 0.5);
    ASSERT_EQ(model.probability(z + 2 * kLuxStopBehindM, z), 0.5);
    ASSERT_GT(model.probability(z, z), 0.5);
  }
}

TEST(ManyCore, BothApproachesBuildTheSameGrid) {
  const AnalyticModel model = lux_model();
  tests::Random random(3);
  for (int round = 0; round < 40; ++round) {
    const Scene scene = random_scene(random);
    const std::vector<PlaneScan> scans = scene.scans();
    const PlaneGrid grid{.x_min_m = -5.0,
                         .y_min_m = -3.0,
                         .cell_m = random.one_in(2) ? 0.1 : 0.2,
                         .columns = 50,
                         .rows = 40};
    const Result cells = by_cells(grid, scans, model);
    const Result beams = by_beams(grid, scans, model);
    ASSERT_EQ(cells.probabilities, beams.probabilities) << round;
    ASSERT_LE(beams.operations.models, cells.operations.models);
  }
}

// Three beams of 20 degrees: to the right one that reaches beyond the grid, ahead a wall at 1.9 m,
// to the left one without a return. A centre at (x, y) lies ahead if |y| < 0.1763 x and to the
// right if -0.5774 x < y < -0.1763 x; the wall is nearest to the centre at 1.879 m.
TEST(ManyCore, DrawsAMap) {
  Scene scene;
  scene.add(Fan(0, 0, 0, 20 * kDegree, 3), {9.0, 1.9, 0.0});
  const PlaneGrid grid{.x_min_m = 0, .y_min_m = -1, .cell_m = 0.25, .columns = 12, .rows = 8};
  const AnalyticModel model = lux_model();
  const std::string expected =
      "            \n"
      "            \n"
      "            \n"
      "   ....o    \n"
      " ......o    \n"
      "   ......   \n"
      "    ........\n"
      "      ......\n";
  EXPECT_EQ(map_of(grid, by_cells(grid, scene.scans(), model).probabilities), expected);
  EXPECT_EQ(map_of(grid, by_beams(grid, scene.scans(), model).probabilities), expected);
}

// Of one scan a cell holds what the model says at its centre's distance, of two what is fused.
TEST(ManyCore, ACellHoldsTheFusedModels) {
  const AnalyticModel model = lux_model();
  const PlaneGrid grid{.x_min_m = 2, .y_min_m = -0.5, .cell_m = 1, .columns = 1, .rows = 1};
  Scene scene;
  scene.add(Fan(0, 0, 0, 40 * kDegree, 1), {2.45});
  EXPECT_EQ(by_beams(grid, scene.scans(), model).probabilities[0], model.probability(2.5, 2.45));
  scene.add(Fan(2.5, -3, 90 * kDegree, 40 * kDegree, 1), {3.1});
  const double both = fuse_bayes(model.probability(2.5, 2.45), model.probability(3.0, 3.1));
  EXPECT_DOUBLE_EQ(by_beams(grid, scene.scans(), model).probabilities[0], both);
  EXPECT_DOUBLE_EQ(by_cells(grid, scene.scans(), model).probabilities[0], both);
}

TEST(ManyCore, CountsWhatItDoes) {
  Scene scene;
  scene.add(Fan(0.05, 0.5, 0, 90 * kDegree, 1), {100.0});
  scene.add(Fan(0.05, 0.5, 0, 90 * kDegree, 1), {0.0});
  const PlaneGrid grid{.x_min_m = 0, .y_min_m = 0, .cell_m = 0.1, .columns = 20, .rows = 10};
  const Operations cells = by_cells(grid, scene.scans(), lux_model()).operations;
  const Operations beams = by_beams(grid, scene.scans(), lux_model()).operations;
  EXPECT_EQ(cells.searches, 2 * grid.cells());  // one for each cell and scan
  EXPECT_EQ(cells.accesses, grid.cells());
  EXPECT_EQ(cells.models, beams.models);  // the beam that returned sees to the grid's end
  EXPECT_EQ(beams.accesses, 2 * beams.models);
  EXPECT_EQ(beams.fusions, beams.models);
  EXPECT_EQ(beams.searches, 20U);  // columns
}

TEST(LuxScans, TakesFirstEchoesByAzimuthAndLayer) {
  LuxScans lux({.x_m = 1.95, .y_m = 0.60, .yaw_deg = 40});
  const auto scans = lux.scans();
  EXPECT_EQ(scans[0].fan->beams(), 201U);
  lux.add({.range_mm = 10'000, .azimuth_ticks = 1600, .layer = 3});
  lux.add({.range_mm = 20'000, .azimuth_ticks = 11'520 - 1600, .layer = 1});
  lux.add({.range_mm = 30'000, .azimuth_ticks = 0, .layer = 2});
  lux.add({.range_mm = 40'000, .azimuth_ticks = 0, .layer = 2, .echo = 1});
  lux.add({.range_mm = 50'000, .azimuth_ticks = 16, .layer = 2, .is_dirt = true});
  lux.add({.range_mm = 50'000, .azimuth_ticks = 32, .layer = 2, .is_rain = true});
  // Seen from above: cos 1.2 degrees = 0.99978, cos 0.4 degrees = 0.99998.
  EXPECT_NEAR(scans[3].ranges_m[200], 9.9978, 1e-4);
  EXPECT_NEAR(scans[1].ranges_m[0], 19.9995, 1e-4);
  EXPECT_NEAR(scans[2].ranges_m[100], 29.9993, 1e-4);
  EXPECT_EQ(scans[2].ranges_m[101], 0);
  EXPECT_EQ(scans[2].ranges_m[102], 0);
  // Azimuth 0 looks where the mount is turned to.
  const Direction ahead = scans[2].fan->direction(100);
  EXPECT_NEAR(std::atan2(ahead.y, ahead.x), 40 * kDegree, 1e-9);
  const Direction left = scans[2].fan->direction(200);
  EXPECT_NEAR(std::atan2(left.y, left.x), 90 * kDegree, 1e-9);
  lux.clear();
  EXPECT_EQ(lux.scans()[3].ranges_m[200], 0);
}

TEST(LuxScans, TakesAFinerStep) {
  LuxScans lux({}, LuxScans::kHalfDegree / 2);
  lux.add({.range_mm = 10'000, .azimuth_ticks = 1600, .layer = 1});
  lux.add({.range_mm = 20'000, .azimuth_ticks = 11'520 - 8, .layer = 1});
  const auto scans = lux.scans();
  EXPECT_EQ(scans[1].fan->beams(), 401U);
  EXPECT_EQ(scans[1].ranges_m.size(), 401U);
  EXPECT_NEAR(scans[1].ranges_m[400], 10, 1e-3);
  EXPECT_NEAR(scans[1].ranges_m[199], 20, 1e-3);
}

}  // namespace
}  // namespace iog::lab::reference
