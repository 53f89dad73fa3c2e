// The sampling that is not the model's against its definition: one cell at a time, with exact
// shares of the line, as integers that need no division.
#include <cstdint>
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
std::map<std::uint32_t, int> steps_of(const Shot& shot) {
  std::map<std::uint32_t, int> steps;
  for (const CellEvidence& seen :
       project(shot.vehicle, {{0, shot.point}}, Sampling::kCentre).cells) {
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

TEST(Sampling, CrossedCellsAreReadAtTheirCentres) {
  for (const Shot& shot : shots(tests::MidCellLux::kVehicle, 11, 25)) {
    const std::vector<Cell> path = crossed_cells(shot);
    std::vector<std::int64_t> cells_1d;
    cells_1d.reserve(path.size());
    for (const Cell cell : path) {
      cells_1d.push_back(cell_1d_of_centre(shot, cell));
    }
    ASSERT_EQ(steps_of(shot), expected(shot, path, cells_1d));
  }
}

}  // namespace
}  // namespace iog::lab
