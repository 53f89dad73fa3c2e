// What echoes of an ultrasonic unit do to a grid (docs/model.md, section 11), against the rule in
// real numbers: which cells lie in the cone, and which cells its arc goes through.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/cells_of.hpp"
#include "fakes/compiled_car.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fusion/frame_fusion.hpp"

namespace iog::grid {
namespace {

using tests::UltrasonicCar;
using vehicle::Vehicle;

constexpr double kPi = 3.14159265358979;

// The sensors' axes, and to where from them an echo's arc reaches: the angular cell around the
// axis and one beside it, in whole ticks of 1/32 degree.
struct Unit {
  double x_m;
  double y_m;
  double yaw_deg;
  double reach_deg;
};
constexpr double kReachDeg = 719 / 32.0;
constexpr std::array<Unit, 4> kUnits{{{2.23, 0.51, 0, kReachDeg},
                                      {-2.17, 0.33, 131, kReachDeg},
                                      {-2.17, 0.33, 131, kReachDeg},
                                      {0.11, -0.97, -93, 959 / 32.0}}};

std::vector<OccupancyIndex> grid_of(std::size_t unit, const lidar::ScanPoint& echo,
                                    const Vehicle& car = UltrasonicCar::kVehicle) {
  auto fusion = std::make_unique<fusion::FrameFusion>(car);
  fusion->add(car.sensors[unit], echo);
  fusion->finish();
  return tests::cells_of(*fusion);
}

// In metres.
double side_of_cell(const geometry::Grid& shape) { return shape.cell_mm / 1000.0; }

// A corner of a cell, as the unit sees it.
struct Polar {
  double range_m;
  double off_deg;
};

Polar polar_of(const Unit& unit, double x_cell, double y_cell, const geometry::Grid& shape) {
  const double x = (x_cell - shape.origin_column) * side_of_cell(shape) - unit.x_m;
  const double y = (y_cell - shape.origin_row) * side_of_cell(shape) - unit.y_m;
  return {std::hypot(x, y), std::remainder(std::atan2(y, x) * 180 / kPi - unit.yaw_deg, 360.0)};
}

// The cells within 5.5 m of the unit, farther than which nothing is known.
std::vector<std::size_t> cells_around(const Unit& unit, const std::vector<OccupancyIndex>& grid,
                                      const geometry::Grid& shape) {
  const auto cell_at = [&](double at_m, int origin_cell) {
    return origin_cell + static_cast<std::int32_t>(std::floor(at_m / side_of_cell(shape)));
  };
  std::vector<std::size_t> near;
  std::ptrdiff_t known = 0;
  for (std::int32_t y = cell_at(unit.y_m - 5.5, shape.origin_row);
       y <= cell_at(unit.y_m + 5.5, shape.origin_row); ++y) {
    for (std::int32_t x = cell_at(unit.x_m - 5.5, shape.origin_column);
         x <= cell_at(unit.x_m + 5.5, shape.origin_column); ++x) {
      if (shape.area().contains({x, y})) {
        near.push_back(static_cast<std::size_t>(geometry::number_of({x, y}, shape.columns)));
        known += grid[near.back()] != 0 ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(known, std::ssize(grid) - std::ranges::count(grid, 0));
  return near;
}

// How far inside the cone the worst corner of a cell is, in metres; below 0 outside.
double depth_of(const Unit& unit, std::size_t number, double free_m,
                const geometry::Grid& shape = {}) {
  const geometry::Cell cell = geometry::cell_of(number, shape.columns);
  double depth = 1e9;
  for (const int dx : {0, 1}) {
    for (const int dy : {0, 1}) {
      const Polar corner = polar_of(unit, cell.x + dx, cell.y + dy, shape);
      const double aside =
          corner.range_m *
          std::sin(std::min(90.0, unit.reach_deg - std::abs(corner.off_deg)) * kPi / 180);
      depth = std::min({depth, free_m - corner.range_m, aside});
    }
  }
  return depth;
}

// 0.05 m and 1D cells of 0.1 m: the 1D cell before that of the echo is not free yet. Ends of lines
// are rounded to a subcell, and the unit stands on one.
void expect_what_lies_in_it_is_free(const Vehicle& car) {
  constexpr double kRounding = 0.001;
  for (std::size_t number = 0; number < 4; ++number) {
    const vehicle::Sensor& sensor = car.sensors[number];
    for (const std::uint32_t range_mm : {240U, 1'999U, 4'999U}) {
      const auto cells = grid_of(number, {.range_mm = range_mm}, car);
      const double free_m = (range_mm / 100 - sensor.profile.near_before_count) * 0.1;
      int freed = 0;
      for (const std::size_t cell : cells_around(kUnits.at(number), cells, car.grid)) {
        const double depth = depth_of(kUnits.at(number), cell, free_m, car.grid);
        if (depth > kRounding) {
          ASSERT_EQ(cells[cell], -1) << number << ", " << range_mm << ", " << cell;
          ++freed;
        } else if (depth < -kRounding) {
          ASSERT_GE(cells[cell], 0) << number << ", " << range_mm << ", " << cell;
        }
      }
      const bool has_some = car.grid.is_whole() && range_mm > 7U * car.grid.cell_mm;
      EXPECT_GT(freed, has_some ? 3 : -1) << number << ", " << range_mm;
    }
  }
}

TEST(Cone, FreesWhatLiesInItWholeAndNothingElse) {
  expect_what_lies_in_it_is_free(UltrasonicCar::kVehicle);
}
TEST(Cone, FreesWhatLiesInItWholeOnEachGrid) {
  for (const description::GridConfig& grid : tests::kOtherGrids) {
    expect_what_lies_in_it_is_free(tests::CarOn<UltrasonicCar>(grid).compiled.vehicle);
  }
}

// The middle of the arc by 2, its sides by 1, and nothing behind it.
void expect_the_arc_is_marked(const Vehicle& car) {
  const double cell_m = side_of_cell(car.grid);
  const double half_diagonal_m = cell_m / std::sqrt(2.0) + 0.0013;
  for (std::size_t number = 0; number < 4; ++number) {
    const Unit& unit = kUnits.at(number);
    for (const std::uint32_t range_mm : {730U, 4'999U}) {
      const auto cells = grid_of(number, {.range_mm = range_mm}, car);
      const double range_m = range_mm / 1000.0;
      int marked = 0;
      for (const std::size_t cell : cells_around(unit, cells, car.grid)) {
        const geometry::Cell at = geometry::cell_of(cell, car.grid.columns);
        const Polar middle = polar_of(unit, at.x + 0.5, at.y + 0.5, car.grid);
        const double off_m = std::abs(middle.range_m - range_m);
        if (cells[cell] > 0) {
          ++marked;
          ASSERT_LE(off_m, half_diagonal_m) << number << ", " << range_mm;
          ASSERT_LE(std::abs(middle.off_deg), unit.reach_deg + 80 * cell_m / range_m);
        }
        if (middle.range_m > range_m + half_diagonal_m) {
          ASSERT_EQ(cells[cell], 0);
        }
      }
      if (car.grid.is_whole()) {
        EXPECT_GE(marked,
                  std::floor(2 * unit.reach_deg * kPi / 180 * range_m / cell_m / std::sqrt(2.0)));
        EXPECT_EQ(*std::ranges::max_element(cells), 2);
        EXPECT_GT(std::ranges::count(cells, 1), range_m > 10 * cell_m ? 0 : -1);
      }
    }
  }
}

TEST(Cone, MarksTheArcAndNothingBehindIt) { expect_the_arc_is_marked(UltrasonicCar::kVehicle); }
TEST(Cone, MarksTheArcOnEachGrid) {
  for (const description::GridConfig& grid : tests::kOtherGrids) {
    expect_the_arc_is_marked(tests::CarOn<UltrasonicCar>(grid).compiled.vehicle);
  }
}

// Upside down its cone is the same.
TEST(Cone, OfAUnitThatHangsUpsideDownIsTheSame) {
  EXPECT_EQ(grid_of(1, {.range_mm = 3'150}), grid_of(2, {.range_mm = 3'150}));
}

// A unit that looks up by 10 degrees frees no farther than its echo reaches in the plan, in which
// its cone is a little wider.
TEST(Cone, OfAUnitThatLooksUpIsShorter) {
  const auto level = grid_of(0, {.range_mm = 3'150});
  const auto up = grid_of(4, {.range_mm = 3'150});
  constexpr double kTilt = 10 * kPi / 180;
  const double wider = std::tan(kReachDeg * kPi / 180) / std::cos(kTilt);
  const Unit unit{2.23, 0.51, 0, std::atan(wider) * 180 / kPi};
  const auto is_free = [](OccupancyIndex index) { return index < 0; };
  EXPECT_LT(std::ranges::count_if(up, is_free), std::ranges::count_if(level, is_free));
  EXPECT_GT(std::ranges::count_if(up, is_free), 0);
  for (std::size_t cell = 0; cell < up.size(); ++cell) {
    if (up[cell] < 0) {
      ASSERT_GT(depth_of(unit, cell, 3.15 * std::cos(kTilt)), -0.001);
    }
  }
}

// What is no echo, or none that is believed, frees nothing: nothing that fails becomes free space.
TEST(Cone, OnlyAnEchoThatMarksFrees) {
  for (const lidar::ScanPoint& point :
       {lidar::ScanPoint{}, lidar::ScanPoint{.range_mm = 1'870, .is_rain = true},
        lidar::ScanPoint{.range_mm = 199}, lidar::ScanPoint{.range_mm = 5'001},
        lidar::ScanPoint{.range_mm = 60'000}}) {
    for (std::size_t number = 0; number < 5; ++number) {
      const auto cells = grid_of(number, point);
      EXPECT_EQ(std::ranges::count(cells, 0), std::ssize(cells)) << point.range_mm;
    }
  }
}

// Echoes of all units in any order are the same grid, and a cell takes no more from an echo than
// one index, however near to the unit it is.
TEST(Cone, TheOrderOfEchoesDoesNotShow) {
  struct Echo {
    std::size_t unit;
    lidar::ScanPoint point;
  };
  tests::Random random(11);
  std::vector<Echo> echoes;
  for (int i = 0; i < tests::effort(60, 12); ++i) {
    echoes.push_back(
        {random.below(5), {.range_mm = static_cast<std::uint32_t>(random.between(200, 5'000))}});
  }
  const auto fuse = [&] {
    auto fusion = std::make_unique<fusion::FrameFusion>(UltrasonicCar::kVehicle);
    for (const Echo& echo : echoes) {
      fusion->add(UltrasonicCar::kVehicle.sensors[echo.unit], echo.point);
    }
    fusion->finish();
    return tests::cells_of(*fusion);
  };
  const auto grid = fuse();
  EXPECT_GE(*std::ranges::min_element(grid), -std::ssize(echoes));
  for (int round = 0; round < tests::effort(5, 2); ++round) {
    for (std::size_t i = echoes.size(); i > 1; --i) {
      std::swap(echoes[i - 1], echoes[random.below(i)]);
    }
    EXPECT_EQ(fuse(), grid);
  }
}

}  // namespace
}  // namespace iog::grid
