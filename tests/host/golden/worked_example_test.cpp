// The numbers of docs/model.md section 9, one by one: the first scan point of packet 7 of
// `iog simulate --seed 1 --seconds 1`, from its wire bytes to the cells of the grid.
#include <algorithm>
#include <array>
#include <cstddef>
#include <gtest/gtest.h>
#include <memory>
#include <span>
#include <vector>

#include "fakes/lux_message.hpp"
#include "fusion/frame_fusion.hpp"
#include "geometry/grid.hpp"
#include "lidar/ibeo_lux.hpp"
#include "traversal/walk.hpp"
#include "vehicle/beam.hpp"
#include "vehicles/cars.hpp"

namespace iog {
namespace {

using geometry::Cell;
using traversal::Position;

const vehicle::Vehicle& kCar = vehicles::car("reference_car").vehicle;
const vehicle::Sensor& kSensor = kCar.sensors[1];

lidar::ScanPoint scan_point() {
  const std::vector<std::byte> message =
      tests::LuxMessage{.points = {{.layer = 0, .angle_ticks = 1600, .range_cm = 895}}}.bytes();
  lidar::IbeoLux packet;
  EXPECT_EQ(packet.decode(message), lidar::DecodeStatus::kOk);
  lidar::ScanPoint read;
  packet.for_each_point([&](const lidar::ScanPoint& point) { read = point; });
  return read;
}

vehicle::BeamLine line_of_the_beam() { return vehicle::aim(kSensor, 0, 1600).line; }

TEST(WorkedExample, TheTenBytesAreThisScanPoint) {
  const std::vector<std::byte> message =
      tests::LuxMessage{.points = {{.layer = 0, .angle_ticks = 1600, .range_cm = 895}}}.bytes();
  constexpr std::array kBytes{0x00, 0x00, 0x40, 0x06, 0x7F, 0x03};
  for (std::size_t i = 0; i < kBytes.size(); ++i) {
    EXPECT_EQ(std::to_integer<int>(message[68 + i]), kBytes[i]);
  }
  const lidar::ScanPoint point = scan_point();
  EXPECT_EQ(point.layer, 0);
  EXPECT_EQ(point.echo, 0);
  EXPECT_EQ(point.azimuth_ticks, 1600);
  EXPECT_EQ(point.range_mm, 8950U);
  EXPECT_EQ(kSensor.precision.divide(point.range_mm), 89U);
}

TEST(WorkedExample, TheLineOfItsBeam) {
  EXPECT_EQ(kSensor.name, "front_centre");
  EXPECT_EQ(kSensor.udp_port, 12003);
  EXPECT_EQ(kSensor.origin.x, 545'280);
  EXPECT_EQ(kSensor.origin.y, 524'288);
  const vehicle::BeamLine line = line_of_the_beam();
  EXPECT_EQ(line.cell({}), (Cell{532, 512}));
  EXPECT_EQ(line.x().offset(), 512U);
  EXPECT_EQ(line.y().offset(), 0U);
  EXPECT_EQ(line.x().length(), 329'035U);
  EXPECT_EQ(line.y().length(), 392'129U);
}

TEST(WorkedExample, TheCellOfTheHitAndTheZonesBeforeIt) {
  const vehicle::BeamLine line = line_of_the_beam();
  EXPECT_EQ(line.through(8950, kSensor.range), (Position{58, 68}));
  EXPECT_EQ(line.through(8800, kSensor.range), (Position{57, 67}));
  EXPECT_EQ(line.through(8700, kSensor.range), (Position{56, 66}));
  EXPECT_EQ(line.cell({58, 68}), (Cell{590, 580}));
}

TEST(WorkedExample, TheIndexesOfItsCells) {
  const auto fusion = std::make_unique<fusion::FrameFusion>(kCar);
  EXPECT_EQ(fusion->add(kSensor, scan_point()), vehicle::Fate::kUsed);
  fusion->finish();
  std::vector<Cell> cells;
  traversal::Walk walk(line_of_the_beam(), {}, geometry::kCellsPerSide);
  walk.until(130, [&](std::size_t number) { cells.push_back(geometry::cell_of(number)); });
  ASSERT_EQ(cells.size(), 130U) << "the line meets no corner here";
  const auto index_at = [&](std::size_t borders) { return int{fusion->view().at(cells[borders])}; };
  for (std::size_t borders = 0; borders <= 121; ++borders) {
    EXPECT_EQ(index_at(borders), -14) << borders;
  }
  EXPECT_EQ(cells[121], (Cell{587, 578}));
  EXPECT_EQ(cells[122], (Cell{588, 578}));
  EXPECT_EQ(index_at(122), -7);
  EXPECT_EQ(cells[123], (Cell{588, 579}));
  EXPECT_EQ(index_at(123), -7);
  EXPECT_EQ(cells[124], (Cell{589, 579}));
  EXPECT_EQ(index_at(124), 0);
  EXPECT_EQ(cells[125], (Cell{589, 580}));
  EXPECT_EQ(index_at(125), 0);
  EXPECT_EQ(cells[126], (Cell{590, 580}));
  EXPECT_EQ(index_at(126), 2);
  EXPECT_EQ(cells[127], (Cell{590, 581}));
  EXPECT_EQ(index_at(127), 0);

  std::vector<index::OccupancyIndex> all(geometry::kCellCount);
  fusion->view().copy_cells(std::span<index::OccupancyIndex, geometry::kCellCount>(all));
  EXPECT_EQ(std::ranges::count(all, -14), 122);
  EXPECT_EQ(std::ranges::count(all, -7), 2);
  EXPECT_EQ(std::ranges::count(all, 2), 1);
  EXPECT_EQ(std::ranges::count(all, 0), std::ssize(all) - 125);
}

}  // namespace
}  // namespace iog
