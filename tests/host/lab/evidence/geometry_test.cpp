// The geometries that are not the model's, each against its definition: one cell at a time, with
// exact shares of the line, as rational numbers or as integers that need no division.
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fusion/frame_fusion.hpp"
#include "lab/evidence/projection.hpp"
#include "lab/reference/exact_line.hpp"
#include "vehicle/beam.hpp"

namespace iog::lab {
namespace {

using geometry::Cell;
using geometry::kResolution;
using lab::reference::Rational;

constexpr std::int64_t kCellsPerLine = 500;  // 1D cells of a LUX

// One beam of a LUX in the middle of the grid, none of whose 50 m leave it.
struct Shot {
  Shot(const vehicle::Vehicle& of, const lidar::ScanPoint& scan_point)
      : vehicle(of),
        sensor(of.sensors[0]),
        point(scan_point),
        line(vehicle::aim(sensor, point.layer, point.azimuth_ticks).line),
        end{sensor.origin.x + line.x().step() * static_cast<std::int32_t>(line.x().length()),
            sensor.origin.y + line.y().step() * static_cast<std::int32_t>(line.y().length())},
        k(point.range_mm / 100) {}

  const vehicle::Vehicle& vehicle;
  const vehicle::Sensor& sensor;
  lidar::ScanPoint point;
  vehicle::BeamLine line;
  geometry::SubcellPoint end;
  std::int64_t k;
};

std::vector<Shot> shots(const vehicle::Vehicle& vehicle, std::uint64_t seed, int count) {
  tests::Random random(seed);
  std::vector<Shot> result;
  while (result.size() < static_cast<std::size_t>(count)) {
    const lidar::ScanPoint point{
        .range_mm = static_cast<std::uint32_t>(random.between(400, 48'000)),
        .azimuth_ticks = static_cast<std::uint16_t>(random.one_in(4) ? random.between(0, 7) * 1440
                                                                     : random.between(0, 11519)),
        .layer = static_cast<std::uint8_t>(random.between(0, 3))};
    result.emplace_back(vehicle, point);
  }
  return result;
}

// The steps of a shot's cells, each cell once.
std::map<std::uint32_t, int> steps_of(const Shot& shot, Geometry geometry) {
  std::map<std::uint32_t, int> steps;
  for (const CellEvidence& seen : project(shot.vehicle, {{0, shot.point}}, geometry).cells) {
    EXPECT_TRUE(steps.emplace(seen.cell, seen.step).second) << "a cell twice";
  }
  return steps;
}

std::uint32_t offset_of(Cell cell) {
  return static_cast<std::uint32_t>(cell.y * geometry::kCellsPerSide + cell.x);
}

// What a path with these 1D cells must look like: nothing behind the last step, the free ones all
// alike.
std::map<std::uint32_t, int> expected(const Shot& shot, const std::vector<Cell>& path,
                                      const std::vector<std::int64_t>& cells_1d) {
  std::map<std::uint32_t, int> steps;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::int64_t step = cells_1d[i] - shot.k;
    if (step <= kFarSteps && geometry::kGridArea.contains(path[i])) {
      steps[offset_of(path[i])] = static_cast<int>(std::max<std::int64_t>(step, -kFarSteps));
    }
  }
  return steps;
}

// All cells in the rectangle around the line whose interior it crosses.
std::vector<Cell> crossed_cells(const Shot& shot) {
  const Cell from = shot.line.cell({});
  const Cell to = shot.line.cell(shot.line.through(traversal::Share{1, 1}));
  std::vector<Cell> cells;
  for (int y = std::min(from.y, to.y) - 1; y <= std::max(from.y, to.y) + 1; ++y) {
    for (int x = std::min(from.x, to.x) - 1; x <= std::max(from.x, to.x) + 1; ++x) {
      if (lab::reference::segment_crosses(shot.sensor.origin, shot.end, {x, y}, kResolution)) {
        cells.push_back({x, y});
      }
    }
  }
  return cells;
}

// floor(d L / Delta) of the share d of the line at which the cell's centre projects on it.
std::int64_t cell_1d_of_centre(const Shot& shot, Cell cell) {
  const std::int64_t wx = std::int64_t{shot.end.x} - shot.sensor.origin.x;
  const std::int64_t wy = std::int64_t{shot.end.y} - shot.sensor.origin.y;
  const std::int64_t along =
      ((2 * std::int64_t{cell.x} + 1) * kResolution - std::int64_t{2} * shot.sensor.origin.x) * wx +
      ((2 * std::int64_t{cell.y} + 1) * kResolution - std::int64_t{2} * shot.sensor.origin.y) * wy;
  return numeric::div_floor(along * kCellsPerLine, 2 * (wx * wx + wy * wy));
}

std::int64_t cell_1d_of_share(Rational share) {
  return share.numerator <= 0
             ? 0
             : numeric::div_floor(share.numerator * kCellsPerLine, share.denominator);
}

TEST(Geometry, CrossedCellsAreReadAtTheirCentres) {
  for (const Shot& shot : shots(tests::MidCellLux::kVehicle, 11, 25)) {
    const std::vector<Cell> path = crossed_cells(shot);
    std::vector<std::int64_t> cells_1d;
    cells_1d.reserve(path.size());
    for (const Cell cell : path) {
      cells_1d.push_back(cell_1d_of_centre(shot, cell));
    }
    ASSERT_EQ(steps_of(shot, {Path::kCrossed, Sampling::kCentre}), expected(shot, path, cells_1d));
  }
}

TEST(Geometry, CrossedCellsAreReadWhereTheLineEnters) {
  for (const Shot& shot : shots(tests::MidCellLux::kVehicle, 12, 25)) {
    const std::vector<Cell> path = crossed_cells(shot);
    std::vector<std::int64_t> cells_1d;
    cells_1d.reserve(path.size());
    for (const Cell cell : path) {
      cells_1d.push_back(cell_1d_of_share(
          lab::reference::cross(shot.sensor.origin, shot.end, cell, kResolution)->enter));
    }
    ASSERT_EQ(steps_of(shot, {Path::kCrossed, Sampling::kEntry}), expected(shot, path, cells_1d));
  }
}

// Bresenham's line by its definition: on each step of the longer axis the cell nearest to the line
// between the centres of the first and the last one, of two equally near ones that further on.
struct Bresenham {
  explicit Bresenham(const Shot& shot) {
    const Cell from = shot.line.cell({});
    const Cell to = shot.line.cell(shot.line.through(traversal::Share{1, 1}));
    const int width = std::abs(to.x - from.x);
    const int height = std::abs(to.y - from.y);
    is_steep = height > width;
    const int n = std::max(width, height);
    const int m = std::min(width, height);
    for (int i = 0; i <= n; ++i) {
      const int aside = n == 0 ? 0 : numeric::div_nearest(i * m, n);
      const int x = is_steep ? aside : i;
      const int y = is_steep ? i : aside;
      path.push_back({from.x + shot.line.x().step() * x, from.y + shot.line.y().step() * y});
    }
  }

  std::vector<Cell> path;
  bool is_steep = false;
};

TEST(Geometry, BresenhamsCellsAreReadAtTheirCentres) {
  for (const Shot& shot : shots(tests::MidCellLux::kVehicle, 13, 200)) {
    const Bresenham bresenham(shot);
    std::vector<std::int64_t> cells_1d;
    cells_1d.reserve(bresenham.path.size());
    for (const Cell cell : bresenham.path) {
      cells_1d.push_back(cell_1d_of_centre(shot, cell));
    }
    ASSERT_EQ(steps_of(shot, {Path::kBresenham, Sampling::kCentre}),
              expected(shot, bresenham.path, cells_1d));
  }
}

// Where the line crosses the n-th border of the longer axis, n = 0, 1, ...
Rational border(const Shot& shot, bool is_steep, std::int64_t n) {
  const std::int64_t start = is_steep ? shot.sensor.origin.y : shot.sensor.origin.x;
  const std::int64_t extent = (is_steep ? shot.end.y : shot.end.x) - start;
  const std::int64_t low = numeric::div_floor<std::int64_t>(start, kResolution) * kResolution;
  return extent > 0 ? Rational{low + n * kResolution - start, extent}
                    : Rational{start - low - kResolution + n * kResolution, -extent};
}

TEST(Geometry, BresenhamsCellsAreEnteredAtTheBordersOfTheLongerAxis) {
  for (const Shot& shot : shots(tests::MidCellLux::kVehicle, 14, 200)) {
    const Bresenham bresenham(shot);
    std::vector<std::int64_t> cells_1d;
    cells_1d.reserve(bresenham.path.size());
    for (std::size_t i = 0; i < bresenham.path.size(); ++i) {
      cells_1d.push_back(
          cell_1d_of_share(border(shot, bresenham.is_steep, static_cast<std::int64_t>(i))));
    }
    ASSERT_EQ(steps_of(shot, {Path::kBresenham, Sampling::kEntry}),
              expected(shot, bresenham.path, cells_1d));
  }
}

// The model's rule on the longer axis alone.
TEST(Geometry, UnderTheModelOneCellOfBresenhamsIsMarked) {
  for (const Shot& shot : shots(tests::MidCellLux::kVehicle, 15, 200)) {
    const Bresenham bresenham(shot);
    const Rational hit{shot.point.range_mm, 50'000};
    std::vector<std::int64_t> cells_1d;
    cells_1d.reserve(bresenham.path.size());
    for (std::size_t i = 0; i < bresenham.path.size(); ++i) {
      const auto n = static_cast<std::int64_t>(i);
      const Rational enter = border(shot, bresenham.is_steep, n);
      const Rational leave = border(shot, bresenham.is_steep, n + 1);
      if (leave <= hit) {
        const std::int64_t left_in =
            -numeric::div_floor(-leave.numerator * kCellsPerLine, leave.denominator) - 1;
        cells_1d.push_back(std::min(left_in, shot.k - 1));
      } else if (enter <= hit) {
        cells_1d.push_back(shot.k);
      } else {
        cells_1d.push_back(std::max(cell_1d_of_share(enter), shot.k + 1));
      }
    }
    ASSERT_EQ(steps_of(shot, {Path::kBresenham, Sampling::kModel}),
              expected(shot, bresenham.path, cells_1d));
  }
}

}  // namespace
}  // namespace iog::lab
