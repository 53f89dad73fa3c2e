// The sampling rule of docs/model.md section 5, against the rule itself: every cell that the line
// crosses, its exact shares of entering and leaving as rational numbers, and the 1D cell they fall
// in.
#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

#include "fakes/compiled_car.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fusion/frame_fusion.hpp"
#include "lab/reference/exact_line.hpp"

namespace iog::grid {
namespace {

using geometry::Cell;
using geometry::kResolution;
using geometry::SubcellPoint;
using lab::reference::Rational;
using tests::OneLux;
using vehicle::Sensor;
using vehicle::Vehicle;

int index_at(const fusion::FrameFusion& fusion, Cell cell) { return fusion.view().at(cell); }

std::unique_ptr<fusion::FrameFusion> fuse_one(const Vehicle& vehicle,
                                              const lidar::ScanPoint& point) {
  auto fusion = std::make_unique<fusion::FrameFusion>(vehicle);
  fusion->add(vehicle.sensors[0], point);
  fusion->finish();
  return fusion;
}

// The row of cells ahead of the sensor after one scan point straight ahead in layer 2.
std::string row_ahead(const Vehicle& vehicle, std::uint32_t range_mm, int first, int last) {
  const auto fusion = fuse_one(vehicle, {.range_mm = range_mm, .layer = 2});
  std::string row;
  for (int x = first; x <= last; ++x) {
    row += std::to_string(index_at(*fusion, {512 + x, 512})) + " ";
  }
  return row;
}

// Where 1D cells and 2D cells share their borders, each 2D cell carries its 1D cell's index.
TEST(Sampling, ALevelBeamFromACornerCarriesTable43) {
  EXPECT_EQ(row_ahead(tests::LevelLux::kVehicle, 10'050, 95, 103), "-14 -14 -14 -7 0 2 0 0 0 ");
  EXPECT_EQ(row_ahead(tests::LevelLux::kVehicle, 10'000, 95, 103), "-14 -14 -14 -7 0 2 0 0 0 ");
  EXPECT_EQ(row_ahead(tests::LevelLux::kVehicle, 10'050, -2, 2), "0 0 -14 -14 -14 ");
}

TEST(Sampling, ABeamFromTheMiddleOfACellCarriesTable43) {
  EXPECT_EQ(row_ahead(tests::MidCellLux::kVehicle, 10'000, 95, 103), "-14 -14 -14 -7 0 2 0 0 0 ");
}

SubcellPoint end_of(const Sensor& sensor, const vehicle::BeamLine& line) {
  return {sensor.origin.x + line.x().step() * static_cast<std::int32_t>(line.x().length()),
          sensor.origin.y + line.y().step() * static_cast<std::int32_t>(line.y().length())};
}

// Floor division of the point at distance z of L, on a border the cell that the line goes on to.
std::int32_t cell_of_point(std::int32_t start, std::int32_t end, std::int64_t z, std::int64_t l) {
  const std::int64_t at = start * l + (std::int64_t{end} - start) * z;
  const std::int64_t side = kResolution * l;
  return static_cast<std::int32_t>(end < start ? -numeric::div_floor(-at, side) - 1
                                               : numeric::div_floor(at, side));
}

// The cell that holds the scan point receives the index of cell k in every direction.
TEST(Sampling, TheCellThatHoldsTheScanPointIsMarkedInEveryDirection) {
  const Vehicle& vehicle = tests::TiltedLux::kVehicle;
  const Sensor& sensor = vehicle.sensors[0];
  auto fusion = std::make_unique<fusion::FrameFusion>(vehicle);
  tests::Random random(21);
  int marked = 0;
  for (int tick = 0; tick < 11520; tick += tests::effort(1, 40)) {
    for (int i = 0; i < 6; ++i) {
      const auto range = static_cast<std::uint32_t>(random.between(30, 5'000) * 10);
      const auto layer = static_cast<std::uint8_t>(random.between(0, 3));
      const lidar::ScanPoint point{
          .range_mm = range, .azimuth_ticks = static_cast<std::uint16_t>(tick), .layer = layer};
      const vehicle::Fate fate = fusion->add(sensor, point);
      fusion->finish();
      const auto line = vehicle::aim(sensor, layer, point.azimuth_ticks).line;
      const SubcellPoint end = end_of(sensor, line);
      const Cell cell{cell_of_point(sensor.origin.x, end.x, range, 50'000),
                      cell_of_point(sensor.origin.y, end.y, range, 50'000)};
      if (fate == vehicle::Fate::kUsed && geometry::kGridArea.contains(cell)) {
        ASSERT_EQ(index_at(*fusion, cell), 2) << "tick " << tick << ", " << range << " mm";
        // Only this cell is occupied: empty the one, and nothing above 0 is left around it.
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const Cell near{cell.x + dx, cell.y + dy};
            if (geometry::kGridArea.contains(near) && (dx != 0 || dy != 0)) {
              ASSERT_LE(index_at(*fusion, near), 0);
            }
          }
        }
        ++marked;
      }
      fusion->clear();
    }
  }
  EXPECT_GT(marked, tests::effort(20'000, 400));
}

// ceil(share * L / Delta) - 1: the 1D cell in which the line still is when it leaves.
std::int64_t leaving_cell(Rational share, std::int64_t cells_per_line) {
  const std::int64_t n = share.numerator * cells_per_line;
  return -numeric::div_floor(-n, share.denominator) - 1;
}

// floor(share * L / Delta): the 1D cell in which the line is as soon as it has entered.
std::int64_t entering_cell(Rational share, std::int64_t cells_per_line) {
  return numeric::div_floor(share.numerator * cells_per_line, share.denominator);
}

// What docs/model.md section 5 says of one cell and one scan point at distance z in 1D cell k.
int expected_index(const Sensor& sensor, SubcellPoint end, Cell cell, std::int64_t range_mm) {
  constexpr std::int64_t kCellsPerLine = 500;
  const std::int64_t k = range_mm / 100;
  const sensor_model::Profile& profile = sensor.profile;
  const Cell hit{cell_of_point(sensor.origin.x, end.x, range_mm, 50'000),
                 cell_of_point(sensor.origin.y, end.y, range_mm, 50'000)};
  if (cell == hit) {
    return profile.hit;
  }
  const Cell start{numeric::div_floor(sensor.origin.x, kResolution),
                   numeric::div_floor(sensor.origin.y, kResolution)};
  const auto crossing = lab::reference::cross(sensor.origin, end, cell, kResolution);
  if (cell == start && (!crossing || crossing->leave <= Rational{0, 1})) {
    return profile.free;  // the start cell counts even where the line only touches it
  }
  if (!crossing || Rational{1, 1} <= crossing->enter || crossing->leave <= Rational{0, 1}) {
    return 0;
  }
  const Rational at{range_mm, 50'000};
  if (crossing->leave <= at) {
    const std::int64_t j = std::min(leaving_cell(crossing->leave, kCellsPerLine), k - 1);
    return profile.at(static_cast<int>(j - k));
  }
  const std::int64_t j = std::max(entering_cell(crossing->enter, kCellsPerLine), k + 1);
  return profile.at(static_cast<int>(j - k));
}

lidar::ScanPoint any_point(tests::Random& random) {
  lidar::ScanPoint point;
  point.azimuth_ticks = static_cast<std::uint16_t>(random.one_in(6) ? random.between(0, 7) * 1440
                                                                    : random.between(0, 11519));
  point.range_mm = static_cast<std::uint32_t>(random.one_in(3) ? random.between(1, 400) * 100
                                                               : random.between(300, 50'000));
  point.layer = static_cast<std::uint8_t>(random.between(0, 3));
  return point;
}

// visit(cell, the index that the rule gives it), for all cells of the rectangle around the line of
// the point, a border of two included.
template <typename Visit>
void for_each_expected(const Vehicle& vehicle, const lidar::ScanPoint& point, Visit&& visit) {
  const Sensor& sensor = vehicle.sensors[0];
  const auto line = vehicle::aim(sensor, point.layer, point.azimuth_ticks).line;
  const SubcellPoint end = end_of(sensor, line);
  const Cell last = line.cell(line.before({1, 1}));
  const Cell first = line.cell({});
  for (int y = std::min(first.y, last.y) - 2; y <= std::max(first.y, last.y) + 2; ++y) {
    for (int x = std::min(first.x, last.x) - 2; x <= std::max(first.x, last.x) + 2; ++x) {
      if (vehicle.grid.area().contains({x, y})) {
        visit(Cell{x, y}, expected_index(sensor, end, {x, y}, point.range_mm));
      }
    }
  }
}

void expect_every_cell_as_the_rule_says(const Vehicle& vehicle, std::uint64_t seed, int beams) {
  const Sensor& sensor = vehicle.sensors[0];
  auto fusion = std::make_unique<fusion::FrameFusion>(vehicle);
  tests::Random random(seed);
  for (int i = 0; i < beams; ++i) {
    const lidar::ScanPoint point = any_point(random);
    const vehicle::Fate fate = fusion->add(sensor, point);
    fusion->finish();
    if (fate == vehicle::Fate::kUsed) {
      for_each_expected(vehicle, point, [&](Cell cell, int index) {
        ASSERT_EQ(index_at(*fusion, cell), index)
            << "cell " << cell.x << ", " << cell.y << ", range " << point.range_mm << ", tick "
            << point.azimuth_ticks << ", layer " << int{point.layer};
      });
    }
    fusion->clear();
  }
}

// A frame of beams within 1.25 degrees, of which each crosses cells that others hit: the sums of
// docs/model.md section 3.
void expect_each_sum_as_bayes_says(const Vehicle& vehicle, std::uint64_t seed, int beams) {
  auto fusion = std::make_unique<fusion::FrameFusion>(vehicle);
  auto alone = std::make_unique<fusion::FrameFusion>(vehicle);
  std::vector<int> freed(geometry::kCellCount);
  std::vector<int> marked(geometry::kCellCount);
  tests::Random random(seed);
  for (int i = 0; i < beams;) {
    lidar::ScanPoint point = any_point(random);
    point.azimuth_ticks %= 40;
    if (alone->add(vehicle.sensors[0], point) != vehicle::Fate::kUsed) {
      continue;
    }
    fusion->add(vehicle.sensors[0], point);
    for_each_expected(vehicle, point, [&](Cell cell, int index) {
      (index < 0
           ? freed
           : marked)[static_cast<std::size_t>(geometry::number_of(cell, vehicle.grid.columns))] +=
          index;
    });
    ++i;
  }
  fusion->finish();
  int mixed = 0;
  for (int y = 0; y < vehicle.grid.rows; ++y) {
    for (int x = 0; x < vehicle.grid.columns; ++x) {
      const auto place =
          static_cast<std::size_t>(geometry::number_of({x, y}, vehicle.grid.columns));
      ASSERT_EQ(index_at(*fusion, {x, y}),
                std::min(std::max(freed[place], -127) + marked[place], 127))
          << x << ", " << y;
      mixed += freed[place] < 0 && marked[place] > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(mixed, 0);
}

TEST(Sampling, EveryCellIsAsTheRuleSaysBlurring) {
  expect_every_cell_as_the_rule_says(OneLux::kVehicle, 31, tests::effort(300, 4));
}
TEST(Sampling, EveryCellIsAsTheRuleSaysNearest) {
  expect_every_cell_as_the_rule_says(tests::OneLuxNearest::kVehicle, 32, tests::effort(300, 4));
}
TEST(Sampling, EveryCellIsAsTheRuleSaysOnEachGrid) {
  for (const description::GridConfig& grid : tests::kOtherGrids) {
    const tests::CarOn<OneLux> car(grid);
    expect_every_cell_as_the_rule_says(car.compiled.vehicle, 33, tests::effort(100, 2));
  }
}

struct BayesLux : OneLux {
  static constexpr description::Description kDescription = [] {
    description::Description car = OneLux::kDescription;
    car.rule = vehicle::FusionRule::kBayes;
    return car;
  }();
};

TEST(Sampling, EachSumIsAsBayesSaysOnEachGrid) {
  expect_each_sum_as_bayes_says(tests::CarOn<BayesLux>({}).compiled.vehicle, 34,
                                tests::effort(60, 20));
  for (const description::GridConfig& grid : tests::kOtherGrids) {
    const tests::CarOn<BayesLux> car(grid);
    expect_each_sum_as_bayes_says(car.compiled.vehicle, 34, tests::effort(60, 20));
  }
}

}  // namespace
}  // namespace iog::grid
