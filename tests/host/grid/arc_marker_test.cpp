// What detections of a radar do to a grid (docs/model.md, section 10), against the rule itself: the
// steps of an arc one by one, their points in rational numbers, and the indexes of Bayes' rule.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "fakes/cells_of.hpp"
#include "fakes/compiled_car.hpp"
#include "fakes/effort.hpp"
#include "fakes/evidence.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fakes/turning_rule.hpp"
#include "fusion/frame_fusion.hpp"

namespace iog::grid {
namespace {

using geometry::Cell;
using geometry::kResolution;
using tests::BayesRadarCar;
using tests::Evidence;
using tests::RadarCar;
using vehicle::Sensor;
using vehicle::Vehicle;

constexpr double kTwoPi = 6.283185307179586;
constexpr int kTicksPerSigma = 16;  // half a degree

// tests/host/sensor_model/arc_test.cpp has these of Bayes' rule: 2 in the middle, 1 beside it.
int index_of(int off_ticks) {
  switch (static_cast<int>(std::floor(std::abs(off_ticks) / double(kTicksPerSigma) + 0.5))) {
    case 0:
      return 2;
    case 1:
      return 1;
    default:
      return 0;
  }
}

// A place on the line that is range / L along it, in units of 1 / L subcells.
struct Place {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

std::int64_t end_on(const traversal::Axis<kResolution>& axis, std::int32_t start) {
  return start + std::int64_t{axis.step()} * axis.length();
}

Place place_of(const Sensor& sensor, const vehicle::BeamLine& line, std::uint32_t range_mm) {
  const auto at = [&](const traversal::Axis<kResolution>& axis, std::int32_t start) {
    return std::int64_t{start} * sensor.range.mm() + (end_on(axis, start) - start) * range_mm;
  };
  return {at(line.x(), sensor.origin.x), at(line.y(), sensor.origin.y)};
}

// On a border the cell that the line goes on to.
std::int32_t cell_on(const traversal::Axis<kResolution>& axis, std::int64_t at, std::int64_t l) {
  const std::int64_t side = kResolution * l;
  return static_cast<std::int32_t>(axis.step() < 0 ? -numeric::div_floor(-at, side) - 1
                                                   : numeric::div_floor(at, side));
}

bool is_on_car(const vehicle::Footprint& car, const Place& place, std::int64_t l) {
  return place.x >= car.x_min * l && place.x <= car.x_max * l && place.y >= car.y_min * l &&
         place.y <= car.y_max * l;
}

std::map<std::pair<int, int>, int> arc_of(const Vehicle& car, const Sensor& sensor,
                                          const lidar::ScanPoint& point) {
  std::map<std::pair<int, int>, int> cells;
  const double ticks_of_a_cell = 11520 * car.grid.cell_mm / (kTwoPi * point.range_mm);
  const int step = std::max(1, static_cast<int>(std::floor(ticks_of_a_cell)));
  for (int off = -400 * step; off <= 400 * step; off += step) {
    if (index_of(off) == 0) {
      continue;
    }
    const auto azimuth = static_cast<std::uint16_t>((point.azimuth_ticks + off + 11520) % 11520);
    const vehicle::BeamLine line = vehicle::aim(sensor, point.layer, azimuth).line;
    const Place place = place_of(sensor, line, point.range_mm);
    const Cell cell{cell_on(line.x(), place.x, sensor.range.mm()),
                    cell_on(line.y(), place.y, sensor.range.mm())};
    if (car.grid.area().contains(cell) && !is_on_car(car.footprint, place, sensor.range.mm())) {
      int& index = cells[{cell.x, cell.y}];
      index = std::max(index, index_of(off));
    }
  }
  return cells;
}

lidar::ScanPoint random_detection(tests::Random& random) {
  return {.range_mm = static_cast<std::uint32_t>(random.one_in(3) ? random.between(100, 6'000)
                                                                  : random.between(100, 80'000)),
          .azimuth_ticks = static_cast<std::uint16_t>(random.between(-1920, 1920) + 11520),
          .layer = static_cast<std::uint8_t>(random.between(24, 36)),
          .is_ground = random.one_in(20),
          .is_rain = random.one_in(20)};
}

lidar::ScanPoint within_a_turn(lidar::ScanPoint point) {
  point.azimuth_ticks = static_cast<std::uint16_t>(point.azimuth_ticks % 11520);
  return point;
}

// By hits_win, what single points make of each cell.
class Sums {
 public:
  explicit Sums(std::int32_t columns) : columns_(columns) {}
  void add(Cell cell, int index) {
    const auto place = static_cast<std::size_t>(geometry::number_of(cell, columns_));
    int& sum = (index > 0 ? occupied_ : free_).at(place);
    sum = std::clamp(sum + index, -127, 127);
  }
  [[nodiscard]] std::vector<OccupancyIndex> joined() const {
    std::vector<OccupancyIndex> cells(geometry::kCellCount);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      cells[i] = static_cast<OccupancyIndex>(occupied_[i] > 0 ? occupied_[i] : free_[i]);
    }
    return cells;
  }

 private:
  std::int32_t columns_;
  std::vector<int> occupied_ = std::vector<int>(geometry::kCellCount);
  std::vector<int> free_ = std::vector<int>(geometry::kCellCount);
};

TEST(ArcMarker, MarksTheArcOfEachDetectionAndNothingElse) {
  const Vehicle& car = RadarCar::kVehicle;
  auto fusion = std::make_unique<fusion::FrameFusion>(car);
  tests::Random random(548);
  Sums sums(geometry::kCellsPerSide);
  int used = 0;
  for (int i = 0; i < tests::effort(4'000, 200); ++i) {
    const Sensor& sensor = car.sensors[1 + random.below(2)];
    const lidar::ScanPoint point = within_a_turn(random_detection(random));
    if (fusion->add(sensor, point) == vehicle::Fate::kUsed) {
      ++used;
      for (const auto& [cell, index] : arc_of(car, sensor, point)) {
        sums.add({cell.first, cell.second}, index);
      }
    }
  }
  fusion->finish();
  EXPECT_GT(used, tests::effort(1'000, 50));
  EXPECT_EQ(tests::cells_of(*fusion), sums.joined());
}

// Half of such an arc may lie on the car, and is the car's own.
TEST(ArcMarker, WhatOfAnArcIsOnTheCarDoesNotMark) {
  const Vehicle& car = tests::RadarBus::kVehicle;
  std::size_t all = 0;
  std::size_t marked = 0;
  for (int off = -13; off <= 13; ++off) {
    const lidar::ScanPoint point =
        within_a_turn({.range_mm = 15'000,
                       .azimuth_ticks = static_cast<std::uint16_t>(11520 + off),
                       .layer = 30});
    auto fusion = std::make_unique<fusion::FrameFusion>(car);
    const vehicle::Fate fate = fusion->add(car.sensors[0], point);
    EXPECT_EQ(fate, off < -12 ? vehicle::Fate::kTooNear : vehicle::Fate::kUsed) << off;
    fusion->finish();
    const auto arc = fate == vehicle::Fate::kUsed ? arc_of(car, car.sensors[0], point)
                                                  : std::map<std::pair<int, int>, int>{};
    const auto cells = tests::cells_of(*fusion);
    for (const auto& [cell, index] : arc) {
      EXPECT_EQ(cells.at(static_cast<std::size_t>(geometry::number_of({cell.first, cell.second}))),
                index);
    }
    const auto count = std::ranges::count_if(cells, [](auto cell) { return cell > 0; });
    EXPECT_EQ(static_cast<std::size_t>(count), arc.size()) << off;
    all += fate == vehicle::Fate::kUsed ? 3 : 0;
    marked += arc.size();
  }
  EXPECT_LT(marked, all);
}

// A detection at 40 m is half a degree wide to either side of its middle, 0.35 m, and once more.
TEST(ArcMarker, AnArcHasNoGaps) {
  const Vehicle& car = RadarCar::kVehicle;
  for (const std::uint32_t range_mm : {500U, 5'000U, 20'000U, 40'000U, 70'000U}) {
    auto fusion = std::make_unique<fusion::FrameFusion>(car);
    fusion->add(car.sensors[1], {.range_mm = range_mm, .layer = 30});
    fusion->finish();
    std::vector<Cell> marked;
    const auto cells = tests::cells_of(*fusion);
    for (std::size_t number = 0; number < cells.size(); ++number) {
      EXPECT_GE(cells[number], 0);
      if (cells[number] > 0) {
        marked.push_back(geometry::cell_of(number));
      }
    }
    if (range_mm == 70'000U) {
      continue;  // beyond the grid
    }
    const double width_m = 2 * 1.5 * 0.5 / 360 * kTwoPi * range_mm / 1000;
    EXPECT_GE(static_cast<double>(marked.size()), std::floor(width_m / 0.15)) << range_mm;
    EXPECT_LE(static_cast<double>(marked.size()), 1.5 * width_m / 0.1 + 2) << range_mm;
    for (const Cell& cell : marked) {
      const auto is_beside = [&](const Cell& other) {
        return cell != other && std::abs(cell.x - other.x) <= 1 && std::abs(cell.y - other.y) <= 1;
      };
      EXPECT_TRUE(marked.size() == 1 || std::ranges::any_of(marked, is_beside)) << range_mm;
    }
  }
}

// Near the radar all of the arc is in one cell, or few, and each counts once.
TEST(ArcMarker, ADetectionMarksACellOnce) {
  const Vehicle& car = RadarCar::kVehicle;
  for (std::uint32_t range_mm = 300; range_mm < 6'000; range_mm += 37) {
    auto fusion = std::make_unique<fusion::FrameFusion>(car);
    fusion->add(car.sensors[1], {.range_mm = range_mm, .azimuth_ticks = 777, .layer = 30});
    fusion->finish();
    const auto cells = tests::cells_of(*fusion);
    EXPECT_LE(std::ranges::max(cells), 2) << range_mm;
  }
}

struct Fates {
  vehicle::Fate of_point;
  lidar::ScanPoint point;
};

TEST(ArcMarker, OnlyADetectionThatIsUsedIsEvidence) {
  using vehicle::Fate;
  const Vehicle& car = RadarCar::kVehicle;
  auto fusion = std::make_unique<fusion::FrameFusion>(car);
  for (const Fates& its :
       {Fates{Fate::kNoReturn, {.layer = 30, .is_rain = true}},
        Fates{Fate::kFlagged, {.range_mm = 9'000, .layer = 30, .is_rain = true}},
        Fates{Fate::kFlagged, {.range_mm = 9'000, .layer = 30, .is_ground = true}},
        Fates{Fate::kTooNear, {.range_mm = 199, .layer = 30}},
        Fates{Fate::kTooFar, {.range_mm = 73'001, .layer = 30}},
        Fates{Fate::kOutsideHeightBand, {.range_mm = 30'000, .layer = 40}}}) {
    EXPECT_EQ(fusion->add(car.sensors[1], its.point), its.of_point);
  }
  fusion->finish();
  EXPECT_TRUE(std::ranges::all_of(tests::cells_of(*fusion), [](auto cell) { return cell == 0; }));
}

std::vector<Evidence> mixed_frame(tests::Random& random, int points) {
  std::vector<Evidence> frame;
  for (int i = 0; i < points; ++i) {
    if (random.one_in(3)) {
      frame.push_back(
          {.sensor = 1 + random.below(2), .point = within_a_turn(random_detection(random))});
    } else {
      frame.push_back({.sensor = 0,
                       .point = {.range_mm = static_cast<std::uint32_t>(random.between(0, 80'000)),
                                 .azimuth_ticks = static_cast<std::uint16_t>(random.below(36'000)),
                                 .layer = static_cast<std::uint8_t>(random.below(16))}});
    }
  }
  return frame;
}

// Adds a point of a level VLP-16. False: rounding might show.
bool add_lidar(const tests::TurningRule& rule, const Sensor& sensor, const geometry::CellArea& area,
               const lidar::ScanPoint& point, Sums& sums) {
  const auto ray = rule.ray(point);
  if (ray) {
    const vehicle::Fate fate = rule.fate(*ray, point);
    const auto add = [&](Cell cell) {
      sums.add(cell, rule.index(sensor.profile, *ray, point, fate, cell));
    };
    tests::for_each_cell_around(*ray, add, area);
  }
  return ray.has_value();
}

// A lidar and two radars, each cell by the rules themselves.
TEST(ArcMarker, AFrameOfLidarAndRadarIsAsTheRulesSayOnEachGrid) {
  for (const description::GridConfig& grid : tests::kOtherGrids) {
    const tests::CarOn<RadarCar> its(grid);
    const Vehicle& car = its.compiled.vehicle;
    const tests::TurningRule rule(its.configs[0], its.description,
                                  lidar::VelodyneVlp16::kElevationsDeg);
    auto fusion = std::make_unique<fusion::FrameFusion>(car);
    tests::Random random(549);
    Sums sums(car.grid.columns);
    for (const Evidence& each : mixed_frame(random, tests::effort(400, 40))) {
      const Sensor& sensor = car.sensors[each.sensor];
      if (each.sensor == 0 && !add_lidar(rule, sensor, car.grid.area(), each.point, sums)) {
        continue;
      }
      const vehicle::Fate fate = fusion->add(sensor, each.point);
      if (each.sensor != 0 && fate == vehicle::Fate::kUsed) {
        for (const auto& [cell, index] : arc_of(car, sensor, each.point)) {
          sums.add({cell.first, cell.second}, index);
        }
      }
    }
    fusion->finish();
    const auto expected = sums.joined();
    EXPECT_LT(std::ranges::min(expected), 0);
    EXPECT_GT(std::ranges::max(expected), 0);
    EXPECT_EQ(tests::cells_of(*fusion), expected) << grid.cell_m;
  }
}

std::vector<OccupancyIndex> grid_of(const Vehicle& car, const std::vector<Evidence>& frame) {
  auto fusion = std::make_unique<fusion::FrameFusion>(car);
  for (const Evidence& each : frame) {
    fusion->add(car.sensors[each.sensor], each.point);
  }
  fusion->finish();
  return tests::cells_of(*fusion);
}

TEST(ArcMarker, TheOrderOfLidarAndRadarDoesNotShow) {
  tests::Random random(5);
  for (const Vehicle* const car : {&RadarCar::kVehicle, &BayesRadarCar::kVehicle}) {
    std::vector<Evidence> frame = mixed_frame(random, tests::effort(30'000, 2'000));
    const auto grid = grid_of(*car, frame);
    EXPECT_LT(std::ranges::min(grid), 0);
    // By hits_win, detections that meet in a cell add up.
    EXPECT_GT(std::ranges::max(grid), car->rule == vehicle::FusionRule::kHitsWin ? 2 : 0);
    for (int round = 0; round < 2; ++round) {
      for (std::size_t i = frame.size(); i > 1; --i) {
        std::swap(frame[i - 1], frame[random.below(i)]);
      }
      ASSERT_EQ(grid_of(*car, frame), grid);
    }
  }
}

// By hits_win what the radar marks stays marked where a lidar's beams pass, by bayes they speak,
// too.
TEST(ArcMarker, ByTheRuleOfTheCarALidarMayOverruleTheRadar) {
  std::vector<Evidence> frame{{.sensor = 1, .point = {.range_mm = 10'000, .layer = 30}}};
  const auto radar = grid_of(RadarCar::kVehicle, frame);
  for (int azimuth = 0; azimuth < 36'000; azimuth += 10) {
    frame.push_back({.sensor = 0,
                     .point = {.range_mm = 30'000,
                               .azimuth_ticks = static_cast<std::uint16_t>(azimuth),
                               .layer = 1}});
  }
  const auto hits_win = grid_of(RadarCar::kVehicle, frame);
  const auto bayes = grid_of(BayesRadarCar::kVehicle, frame);
  int marked = 0;
  for (std::size_t i = 0; i < radar.size(); ++i) {
    if (radar[i] > 0) {
      EXPECT_EQ(hits_win[i], radar[i]);
      EXPECT_LT(bayes[i], 0);
      ++marked;
    }
  }
  EXPECT_GT(marked, 1);
}

}  // namespace
}  // namespace iog::grid
