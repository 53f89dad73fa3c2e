// The fusion of a frame (docs/model.md section 3): what one hit and many passing beams are worth,
// and that no order shows.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <span>
#include <vector>

#include "fakes/cells_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/evidence.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fusion/frame_fusion.hpp"
#include "tools/car/scanners.hpp"
#include "tools/car/tables.hpp"

namespace iog::fusion {
namespace {

using grid::OccupancyIndex;
using tests::Evidence;
using tests::LevelLux;
using tests::random_frame;
using tests::ThreeLux;
using tests::TiltedLux;
using vehicle::Vehicle;

std::vector<OccupancyIndex> fuse(const Vehicle& vehicle, const std::vector<Evidence>& frame) {
  const auto fusion = std::make_unique<FrameFusion>(vehicle);
  for (const Evidence& evidence : frame) {
    fusion->add(vehicle.sensors[evidence.sensor], evidence.point);
  }
  fusion->finish();
  return tests::cells_of(*fusion);
}

int ahead(const std::vector<OccupancyIndex>& cells, int x) {
  const int offset = 512 * geometry::kCellsPerSide + 512 + x;
  return cells[static_cast<std::size_t>(offset)];
}

Vehicle with_rule(Vehicle vehicle, vehicle::FusionRule rule) {
  vehicle.rule = rule;
  return vehicle;
}

Evidence level(std::uint32_t range_mm) { return {0, {.range_mm = range_mm, .layer = 2}}; }

// A hit at 5 m, and a beam that passes over it to 10 m: +2 and -14 in one cell.
TEST(Fusion, AHitSurvivesABeamThatPassesOverItIfHitsWin) {
  const std::vector<Evidence> frame{level(5'050), level(10'050)};
  EXPECT_EQ(ahead(fuse(LevelLux::kVehicle, frame), 50), 2);
  EXPECT_EQ(ahead(fuse(with_rule(LevelLux::kVehicle, vehicle::FusionRule::kBayes), frame), 50),
            -12);
}

// A car block may say what no sensor's profile does: nothing in the first 1D cell behind a hit, and
// something in the second.
TEST(Fusion, AGapBehindAHitStaysUnknown) {
  std::vector<vehicle::Sensor> sensors(1, LevelLux::kVehicle.sensors[0]);
  sensors[0].profile.near_after = {0, 3};
  sensors[0].profile.near_after_count = 2;
  Vehicle car = LevelLux::kVehicle;
  car.sensors = sensors;
  const auto cells = fuse(car, {level(5'050)});
  EXPECT_EQ(ahead(cells, 50), 2);
  EXPECT_EQ(ahead(cells, 51), 0);
  EXPECT_EQ(ahead(cells, 52), 3);
  EXPECT_EQ(ahead(cells, 53), 0);
}

// Of a level unit with eight layers: those as far up and as far down are over the same cells.
TEST(Fusion, LayersAsFarUpAsDownAreOfOneLine) {
  description::SensorConfig config = description::scanner_of(lidar::kFormat<lidar::IbeoLux8>);
  config.beam_tilt_deg = 1.6;
  const std::vector sensors{description::sensor_of(config, tests::OneLux::kDescription)};
  Vehicle car = tests::OneLux::kVehicle;
  car.sensors = sensors;
  for (const std::uint8_t layer : {std::uint8_t{0}, std::uint8_t{1}}) {
    const auto opposite = static_cast<std::uint8_t>(7 - layer);
    EXPECT_EQ(sensors[0].layers[opposite].line, sensors[0].layers[layer].line);
    const auto fused = [&](std::uint8_t its) {
      return fuse(car, {{0, {.range_mm = 12'340, .azimuth_ticks = 300, .layer = its}}});
    };
    EXPECT_EQ(fused(opposite), fused(layer));
  }
}

// From 70 m ahead, 19 m beside the grid: one beam looks into it, the other one away from it.
TEST(Fusion, ABeamThatNeverMeetsTheGridSaysNothing) {
  constexpr std::uint16_t kAway = 5'760;
  const auto is_anything_known = [](std::uint16_t azimuth_ticks) {
    const auto cells =
        fuse(ThreeLux::kVehicle,
             {{2, {.range_mm = 30'000, .azimuth_ticks = azimuth_ticks, .layer = 2}}});
    return std::ranges::any_of(cells, [](OccupancyIndex its) { return its != 0; });
  };
  EXPECT_TRUE(is_anything_known(0));
  EXPECT_FALSE(is_anything_known(kAway));
}

// Rising by 0.4 degrees, the beam leaves each 2D cell a fraction of a millimetre late, in the next
// 1D cell: from a corner the zones before the hit reach one cell further back, which overstates
// nothing. (At coarse resolutions the fraction is lost, hence not among the laws of sampling.)
TEST(Fusion, ATiltedBeamFromACornerCarvesOneCellLess) {
  const auto row = [](const Vehicle& vehicle) {
    const auto cells = fuse(vehicle, {level(10'050)});
    std::vector<int> indexes;
    for (int x = 95; x <= 102; ++x) {
      indexes.push_back(ahead(cells, x));
    }
    return indexes;
  };
  EXPECT_EQ(row(tests::OneLux::kVehicle), (std::vector{-14, -14, -7, 0, 0, 2, 0, 0}));
  EXPECT_EQ(row(tests::OneLuxNearest::kVehicle), (std::vector{-15, -15, -7, 0, 0, 2, 1, 0}));
}

TEST(Fusion, HitsAddUpAndSaturateAt127) {
  EXPECT_EQ(ahead(fuse(LevelLux::kVehicle, {3, level(5'050)}), 50), 6);
  EXPECT_EQ(ahead(fuse(LevelLux::kVehicle, {64, level(5'050)}), 50), 127);
}

TEST(Fusion, CarvingSaturatesAtMinus127) {
  EXPECT_EQ(ahead(fuse(LevelLux::kVehicle, {9, level(10'050)}), 50), -126);
  EXPECT_EQ(ahead(fuse(LevelLux::kVehicle, {10, level(10'050)}), 50), -127);
  EXPECT_EQ(ahead(fuse(LevelLux::kVehicle, {11, level(10'050)}), 50), -127);
}

// bayes: sat(sat(0 + -140) + 2) = -125: the marks are added to the saturated carving.
TEST(Fusion, BayesSaturatesTheCarvingBeforeTheMarks) {
  std::vector<Evidence> frame(10, level(10'050));
  frame.push_back(level(5'050));
  EXPECT_EQ(ahead(fuse(with_rule(LevelLux::kVehicle, vehicle::FusionRule::kBayes), frame), 50),
            -125);
}

TEST(Fusion, ALaterEchoMarksAndCarvesNothing) {
  const auto cells =
      fuse(LevelLux::kVehicle, {level(5'050), {0, {.range_mm = 10'050, .layer = 2, .echo = 1}}});
  EXPECT_EQ(ahead(cells, 50), 2);
  EXPECT_EQ(ahead(cells, 100), 2);
  EXPECT_EQ(ahead(cells, 75), 0);
  EXPECT_EQ(ahead(cells, 20), -14);
}

TEST(Fusion, GroundCarvesAndDoesNotMark) {
  const auto cells =
      fuse(LevelLux::kVehicle, {{0, {.range_mm = 5'050, .layer = 2, .is_ground = true}}});
  EXPECT_EQ(ahead(cells, 20), -14);
  EXPECT_EQ(ahead(cells, 48), -7);
  EXPECT_EQ(ahead(cells, 50), 0);
}

// Beyond the model's range: free up to it. The scan point is so far off that every cell is before
// k - 2, and at 50.05 m the last cells are as near to it as the profile says.
TEST(Fusion, AFarPointCarvesUpToTheRange) {
  const auto far = fuse(LevelLux::kVehicle, {level(90'000)});
  EXPECT_EQ(ahead(far, 0), -14);
  EXPECT_EQ(ahead(far, 499), -14);
  EXPECT_EQ(ahead(far, 500), 0);
  const auto near = fuse(LevelLux::kVehicle, {level(50'050)});
  EXPECT_EQ(ahead(near, 497), -14);
  EXPECT_EQ(ahead(near, 498), -7);
  EXPECT_EQ(ahead(near, 499), 0);
  EXPECT_EQ(ahead(near, 500), 0);
}

// Ahead of LevelLux 1D cells and cells share their borders: cell x takes the index of 1D cell x. So
// a point a little too far away is as near to the last cells as the profile says, millimetre by
// millimetre, and 0.3 m behind the line's end no zone is left on it.
TEST(Fusion, APointJustBeyondTheRangeIsNearTheLastCells) {
  const auto fusion = std::make_unique<FrameFusion>(LevelLux::kVehicle);
  constexpr auto kStep = static_cast<std::uint32_t>(tests::effort(1, 37));
  for (std::uint32_t range_mm = 49'990; range_mm <= 50'500; range_mm += kStep) {
    fusion->add(LevelLux::kVehicle.sensors[0], level(range_mm).point);
    fusion->finish();
    for (int x = 490; x < 500; ++x) {
      const int before = static_cast<int>(range_mm / 100) - x;
      const int carved = before >= 3 ? -14 : before == 2 ? -7 : 0;
      const int expected = before == 0 ? 2 : carved;
      ASSERT_EQ(int{fusion->view().at({512 + x, 512})}, expected) << range_mm << ", " << x;
    }
    fusion->clear();
  }
}

TEST(Fusion, APointAtTheRangeItselfIsUsed) {
  const auto cells = fuse(LevelLux::kVehicle, {level(50'000)});
  EXPECT_EQ(ahead(cells, 500), 2);
  EXPECT_EQ(ahead(cells, 498), -7);
}

// A missing return is no evidence, unless the description says that it clears: TiltedLux clears 20
// m where its beam is inside the height band.
TEST(Fusion, AMissingReturnClearsOnlyWhereTheDescriptionSaysSo) {
  const auto count = [](const std::vector<OccupancyIndex>& cells) {
    return std::ranges::count_if(cells, [](OccupancyIndex index) { return index != 0; });
  };
  EXPECT_EQ(count(fuse(LevelLux::kVehicle, {level(0)})), 0);
  const auto cleared = fuse(TiltedLux::kVehicle, {{0, {.range_mm = 0, .layer = 3}}});
  EXPECT_GT(count(cleared), 200);
  EXPECT_TRUE(std::ranges::all_of(cleared, [](OccupancyIndex i) { return i == 0 || i == -14; }));
}

// Layer 0 of TiltedLux leaves its band 5.5 m ahead; a point at 30 m carves no further.
TEST(Fusion, ABeamCarvesOnlyInsideTheHeightBand) {
  const auto cells = fuse(TiltedLux::kVehicle, {{0, {.range_mm = 30'000}}});
  double farthest_m = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] != 0) {
      EXPECT_EQ(int{cells[i]}, -14);
      const std::size_t column = i % geometry::kCellsPerSide;
      const std::size_t row = i / geometry::kCellsPerSide;
      const double x = (static_cast<double>(column) - 511.5) / 10 - 1.234;
      const double y = (static_cast<double>(row) - 511.5) / 10 + 0.777;
      farthest_m = std::max(farthest_m, std::hypot(x, y));
    }
  }
  EXPECT_NEAR(farthest_m, 5.54, 0.15);
}

// A sensor outside the grid sees what lies inside it, as if the grid went on.
TEST(Fusion, ASensorOutsideTheGridCarvesInside) {
  const auto cells = fuse(ThreeLux::kVehicle, {{2, {.range_mm = 30'000, .layer = 2}}});
  const auto marked = std::ranges::count_if(cells, [](OccupancyIndex i) { return i > 0; });
  const auto carved = std::ranges::count_if(cells, [](OccupancyIndex i) { return i < 0; });
  EXPECT_EQ(marked, 1);
  EXPECT_NEAR(static_cast<double>(carved), 300 - 189, 4);  // from x = 51.2 m to 40.1 m
}

TEST(Fusion, NoOrderOfTheScanPointsShowsInTheGrid) {
  tests::Random random(41);
  for (const auto rule : {vehicle::FusionRule::kHitsWin, vehicle::FusionRule::kBayes}) {
    const Vehicle vehicle = with_rule(ThreeLux::kVehicle, rule);
    std::vector<Evidence> frame = random_frame(random, tests::effort(3000, 300));
    const auto expected = fuse(vehicle, frame);
    for (int shuffle = 0; shuffle < tests::effort(20, 3); ++shuffle) {
      for (std::size_t i = frame.size(); i > 1; --i) {
        std::swap(frame[i - 1], frame[random.below(i)]);
      }
      ASSERT_EQ(fuse(vehicle, frame), expected);
    }
  }
}

// Beams of one line wait for one another, but what each carves is the same: here, carved at once.
TEST(Fusion, BeamsThatWaitCarveAsIfTheyHadNot) {
  tests::Random random(42);
  for (const Vehicle& vehicle : {LevelLux::kVehicle, ThreeLux::kVehicle, TiltedLux::kVehicle}) {
    std::vector<Evidence> frame = random_frame(random, tests::effort(2000, 200));
    const auto at_once = std::make_unique<FrameFusion>(vehicle);
    for (Evidence& evidence : frame) {
      evidence.sensor %= vehicle.sensors.size();
      // A few azimuths only, so that many beams share a line, some of them the whole of it.
      evidence.point.azimuth_ticks = static_cast<std::uint16_t>(evidence.point.azimuth_ticks / 64);
      at_once->add(vehicle.sensors[evidence.sensor], evidence.point);
      at_once->carve_waiting();
    }
    at_once->finish();
    ASSERT_EQ(fuse(vehicle, frame), tests::cells_of(*at_once));
  }
}

// Lines are kept per azimuth, and found again where another azimuth took their place: 11,520
// azimuths share 3,328 places. Nothing of that shows in the grid: a fusion that has had frames
// before fuses as a new one, which has to find each line.
TEST(Fusion, ALineThatWasKeptIsTheLineThatIsFound) {
  tests::Random random(43);
  for (const Vehicle& vehicle : {LevelLux::kVehicle, ThreeLux::kVehicle, TiltedLux::kVehicle}) {
    const auto keeps = std::make_unique<FrameFusion>(vehicle);
    for (int frame = 0; frame < 4; ++frame) {
      std::vector<Evidence> evidence = random_frame(random, tests::effort(1500, 100));
      const auto finds = std::make_unique<FrameFusion>(vehicle);
      for (Evidence& one : evidence) {
        one.sensor %= vehicle.sensors.size();
        if (frame % 2 == 0) {  // few azimuths, which are the next frame's, too
          one.point.azimuth_ticks = static_cast<std::uint16_t>(one.point.azimuth_ticks / 64 * 16);
        }
        keeps->add(vehicle.sensors[one.sensor], one.point);
        finds->add(vehicle.sensors[one.sensor], one.point);
      }
      keeps->finish();
      finds->finish();
      ASSERT_EQ(tests::cells_of(*keeps), tests::cells_of(*finds));
      keeps->clear();
    }
  }
}

// The owner shows what is known once, in order, and keeps nothing of it.
TEST(Fusion, AFrameThatIsReleasedIsShownTileByTileAndCleared) {
  tests::Random random(44);
  const auto fusion = std::make_unique<FrameFusion>(ThreeLux::kVehicle);
  for (const Evidence& evidence : random_frame(random, 100)) {
    fusion->add(ThreeLux::kVehicle.sensors[evidence.sensor], evidence.point);
  }
  fusion->finish();
  const auto cells = tests::cells_of(*fusion);
  std::vector<std::size_t> tiles;
  std::vector<OccupancyIndex> shown(geometry::kCellCount);
  fusion->release([&](std::size_t tile,
                      std::span<const OccupancyIndex, geometry::kTileCells> indexes) {
    tiles.push_back(tile);
    const std::size_t corner = (tile / geometry::kTilesPerSide * geometry::kCellsPerSide +
                                tile % geometry::kTilesPerSide) *
                               geometry::kTileSide;
    for (std::size_t i = 0; i < indexes.size(); ++i) {
      shown[corner + i / geometry::kTileSide * geometry::kCellsPerSide + i % geometry::kTileSide] =
          indexes[i];
    }
  });
  EXPECT_GT(tiles.size(), 10U);
  EXPECT_TRUE(std::ranges::is_sorted(tiles));
  EXPECT_EQ(std::ranges::adjacent_find(tiles), tiles.end());
  EXPECT_TRUE(shown == cells);
  EXPECT_EQ(std::ranges::count(tests::cells_of(*fusion), 0), std::ssize(cells));
  fusion->release([&](auto...) { FAIL() << "nothing is known"; });
}

}  // namespace
}  // namespace iog::fusion
