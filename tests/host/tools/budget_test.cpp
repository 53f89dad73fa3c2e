#include <array>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/ground_car.hpp"
#include "lidar/formats.hpp"
#include "tools/budget/frame_budget.hpp"
#include "tools/budget/unit_costs.hpp"
#include "tools/car/tables.hpp"
#include "tools/vehicles/unused_band.hpp"
#include "tools/vehicles/upward_mount.hpp"

namespace iog::tools {
namespace {

constexpr double kCyclesPerMs = 1e6;

// The two drives that the costs are made of differ by a third in what a cell takes: what both are
// reckoned with is up to a tenth off either.
TEST(Budget, IsATenthOffTheWholeFramesThatItIsMadeOf) {
  for (const ModelledFrame& frame : kWholeFrames) {
    const double ms =
        typical_ms({.points = frame.points, .cells = frame.cells, .tiles = frame.tiles});
    EXPECT_NEAR(ms / (frame.cycles / kCyclesPerMs), 1, 0.10) << frame.name;
  }
}

// Frames that it is not made of: raw tiles leave the caches as they were, so fusing is cheaper, and
// the budget up to two fifths above it.
TEST(Budget, IsUpToTwoFifthsOffFusingAlone) {
  for (const ModelledFrame& frame : kFusedFrames) {
    const double ms = typical_ms({.points = frame.points, .cells = frame.cells});
    EXPECT_NEAR(ms / (frame.cycles / kCyclesPerMs), 1, 0.40) << frame.name;
  }
}

// Three turns, from the packet to the last tile. What a tile costs is that of the reference car's.
TEST(Budget, IsAFifthOffTheTurnsThatItIsMadeOf) {
  for (const ModelledTurn& turn : kTurns) {
    const double ms =
        typical_ms({.turn_steps = kTurnSteps, .turn_points = turn.points, .tiles = turn.tiles});
    EXPECT_NEAR(ms / (turn.cycles / kCyclesPerMs), 1, 0.20) << turn.name;
  }
}

TEST(Budget, IsAFifthOffTheTurnsThatFollowTheGround) {
  for (const ModelledTurn& turn : kGroundTurns) {
    const double ms = typical_ms({.turn_steps = kTurnSteps,
                                  .turn_points = turn.points,
                                  .ground_turns = 1,
                                  .ground_points = turn.points,
                                  .tiles = turn.tiles});
    EXPECT_NEAR(ms / (turn.cycles / kCyclesPerMs), 1, 0.20) << turn.name;
  }
}

TEST(Budget, IsAFifthOffWhatMovedTakesOfFramesWithClasses) {
  for (const ModelledFramePart& frame : kMovedFrames) {
    const double ms = typical_ms({.moved_frames = 1, .moved_points = frame.points});
    EXPECT_NEAR(ms / (frame.cycles / kCyclesPerMs), 1, 0.20) << frame.name;
  }
}

vehicle::Vehicle of_indexes(const CatalogueEntry& car) {
  vehicle::Vehicle vehicle = *car.vehicle;
  vehicle.grids = vehicle::Grids::kIndexes;
  if (lidar::turns(vehicle.sensors.front().format)) {
    vehicle.frame_period_us = 150'000;  // a turn, as such a car has it by default
  }
  return vehicle;
}

// Of a turn of 100 ms.
TEST(Budget, OfAFrameThatIsShorterThanATurnIsThatOfItsPart) {
  CatalogueEntry car = find_vehicle("roof_hdl64e");
  vehicle::Vehicle its = *car.vehicle;
  car.vehicle = &its;
  its.frame_period_us = 150'000;
  const FrameWork turn = budget_of(car).typical.work;
  its.frame_period_us = 40'000;
  const VehicleBudget budget = budget_of(car);
  EXPECT_EQ(budget.period_ms, 40);
  EXPECT_DOUBLE_EQ(budget.typical.work.turn_points, 0.4 * turn.turn_points);
  EXPECT_DOUBLE_EQ(budget.typical.work.turn_steps, 0.4 * turn.turn_steps);
  EXPECT_DOUBLE_EQ(budget.typical.work.ground_turns, 0.4);
  EXPECT_DOUBLE_EQ(budget.typical.work.ground_points, 0.4 * turn.ground_points);
  EXPECT_EQ(budget.typical.work.tiles, turn.tiles);
}

TEST(Budget, OfACarThatOpensGroundOnlyFromBelowHasWhatThatCosts) {
  CatalogueEntry car = find_vehicle("roof_hdl64e");
  const tests::GroundCar opens(*car.vehicle, {220, 2'200}, {.low_mm = 600, .tall_mm = 500});
  vehicle::Vehicle its = opens.vehicle();
  its.frame_period_us = 40'000;
  its.grids = vehicle::Grids::kIndexes;
  car.vehicle = &its;
  EXPECT_EQ(budget_of(car).typical.work.moved_frames, 0) << "it makes no classes";
  its.grids = vehicle::Grids::kClasses;
  const VehicleBudget budget = budget_of(car);
  for (const FrameBudget& frame : {budget.typical, budget.worst}) {
    EXPECT_EQ(frame.work.moved_frames, 1);
    EXPECT_EQ(frame.work.moved_points, frame.work.ground_points);
  }
  const tests::GroundCar opens_all(*find_vehicle("roof_hdl64e").vehicle);
  vehicle::Vehicle without = opens_all.vehicle();
  without.frame_period_us = 40'000;
  without.grids = vehicle::Grids::kClasses;
  car.vehicle = &without;
  const VehicleBudget less = budget_of(car);
  EXPECT_EQ(less.typical.work.moved_frames, 0);
  const double points = budget.typical.work.moved_points;
  EXPECT_NEAR(budget.typical.ms - less.typical.ms,
              (kMovedFrameCycles + points * kMovedPointCycles) / kCyclesPerMs, 1e-9);
}

// From the description alone, which allows some more points than the unit sends: as it is, and
// without the key that lets it follow the ground.
TEST(Budget, OfAUnitThatTurnsIsThatOfItsTurn) {
  constexpr std::array kVehicles{"roof_vlp16", "roof_hdl32e", "roof_hdl64e"};
  ASSERT_EQ(kTurns.size(), kVehicles.size());
  for (std::size_t i = 0; i < kTurns.size(); ++i) {
    CatalogueEntry car = find_vehicle(kVehicles[i]);
    const vehicle::Vehicle its = of_indexes(car);
    car.vehicle = &its;
    const FrameBudget typical = budget_of(car).typical;
    EXPECT_NEAR(typical.work.turn_points / kGroundTurns[i].points, 1, 0.10) << kTurns[i].name;
    EXPECT_EQ(typical.work.turn_steps, kTurnSteps);
    EXPECT_EQ(typical.work.points_once, 0);
    EXPECT_EQ(typical.work.ground_turns, 1);
    EXPECT_EQ(typical.work.ground_points, typical.work.turn_points);
    EXPECT_NEAR(typical.ms / (kGroundTurns[i].cycles / kCyclesPerMs), 1, 0.30) << kTurns[i].name;
    const tests::GroundCar flat(*car.vehicle, {});
    car.vehicle = &flat.vehicle();
    const FrameBudget by_band = budget_of(car).typical;
    EXPECT_EQ(by_band.work.ground_points, 0);
    EXPECT_NEAR(by_band.ms / (kTurns[i].cycles / kCyclesPerMs), 1, 0.30) << kTurns[i].name;
  }
}

// A tilt takes nothing of the turn away that ends the frame, whose period is then that of a level
// unit; which points come, and of how many tiles, is the same, too.
TEST(Budget, OfAUnitThatIsNotLevelIsThatOfItsTurn) {
  const CatalogueEntry level = find_vehicle("roof_vlp16");
  std::vector<description::SensorConfig> sensors(level.sensors.begin(), level.sensors.end());
  sensors[0].mount.pitch_deg = -6;
  const std::array tables{description::sensor_of(sensors[0], *level.description)};
  description::Description description = *level.description;
  description.grids = vehicle::Grids::kIndexes;
  const vehicle::Vehicle its = description::vehicle_of(description, tables);
  CatalogueEntry car = level;
  car.vehicle = &its;
  car.sensors = sensors;
  ASSERT_FALSE(its.sensors[0].layers_share_lines);
  const VehicleBudget pitched = budget_of(car);
  EXPECT_EQ(pitched.period_ms, 100);
  EXPECT_EQ(pitched.typical.work.tilted_points, budget_of(level).typical.work.turn_points);
  EXPECT_EQ(pitched.typical.work.points_once, 0);
  // The model's frame of one pitched by 3 degrees, 64-bit divisions at the rate of the rest.
  EXPECT_NEAR(pitched.typical.ms / 99.9, 1, 0.3);
  EXPECT_NEAR(pitched.typical.work.tiles / budget_of(level).typical.work.tiles, 1, 0.1);
  EXPECT_EQ(pitched.typical.work.ground_turns, 1);
  EXPECT_EQ(
      warning_of_upward_mounts(car),
      "warning: roof_vlp16: sensor roof: pitch_deg = -6 looks up by 6 degrees; one that looks "
      "down has a positive pitch_deg (iog mount)\n");
  EXPECT_EQ(warning_of_upward_mounts(level), "");
}

// A VLP-16 follows the ground, so that the band of the car does not matter. A LUX needs it.
TEST(UnusedBand, IsTold) {
  const auto warning_with = [](const char* vehicle, double z_min_m, double z_max_m) {
    CatalogueEntry car = find_vehicle(vehicle);
    description::Description description = *car.description;
    description.z_min_m = z_min_m;
    description.z_max_m = z_max_m;
    car.description = &description;
    return warning_of_unused_band(car);
  };
  EXPECT_EQ(warning_with("roof_vlp16", 0.3, 4),
            "warning: roof_vlp16: z_min_m = 0.3 and z_max_m = 4 have no effect, because each "
            "sensor follows the ground; ground = { low_m = 0.22, top_m = 2.2 } of sensor roof says "
            "how high obstacles are\n");
  EXPECT_NE(warning_with("roof_vlp16", 0.1, 2.2), "");
  EXPECT_EQ(warning_with("roof_vlp16", 0.3, 2.2), "");
  EXPECT_EQ(warning_with("reference_car", 0.1, 4), "");
  for (const CatalogueEntry& car : all_vehicles()) {
    EXPECT_EQ(warning_of_unused_band(car), "");
  }
}

// From the description alone: the mean of both drives.
TEST(Budget, OfTheReferenceCarsDescriptionIsThatOfItsDrives) {
  FrameWork work = budget_of(find_vehicle("reference_car")).typical.work;
  work.class_tiles = 0;
  double mean_ms = 0;
  for (const ModelledFrame& frame : kWholeFrames) {
    mean_ms += frame.cycles / kCyclesPerMs / static_cast<double>(kWholeFrames.size());
  }
  EXPECT_NEAR(typical_ms(work) / mean_ms, 1, 0.05);
  EXPECT_EQ(work.points_once, 0);
}

TEST(Budget, NoFrameThatIsKnownIsWorseThanTheWorst) {
  const FrameBudget worst = budget_of(find_vehicle("reference_car")).worst;
  const double classes_ms = worst.work.class_tiles * kDearestClassTileCycles / kCyclesPerMs;
  for (const ModelledFrame& frame : kWorstFrames) {
    EXPECT_LT(frame.cycles / kCyclesPerMs, worst.ms - classes_ms) << frame.name;
    EXPECT_LE(frame.points, worst.work.points_once + worst.work.later_echoes) << frame.name;
    EXPECT_LE(frame.tiles, worst.work.tiles) << frame.name;
  }
}

// 2 x 4 x 401 directions of three echoes; one sensor of 80 packets of 384 points, twice returned.
TEST(Budget, CountsWhatDescriptionsAllow) {
  const VehicleBudget lux = budget_of(find_vehicle("two_lux_parking"));
  EXPECT_EQ(lux.period_ms, 40);
  EXPECT_EQ(lux.worst.work.points_once, 2 * 4 * 401);
  EXPECT_EQ(lux.worst.work.later_echoes, 2 * 2 * 4 * 401);
  EXPECT_EQ(lux.worst.work.class_tiles, 0);
  const VehicleBudget roof = budget_of(find_vehicle("roof_vlp16"));
  EXPECT_EQ(roof.period_ms, 100);
  EXPECT_EQ(roof.worst.work.points_once, 80 * 384);
  EXPECT_EQ(roof.worst.work.tiles, 1024);
  EXPECT_EQ(roof.typical.work.points, 0);
}

// The file of the Pandar64 has no room for two returns, and an Ouster with two has a profile of its
// own: 64 lasers in 1,800 and 1,024 directions, of which the file of the former allows some more. A
// frame of 40 ms has 0.4 of them.
TEST(Budget, OfAUnitWithOneReturnIsThatOfAllItsPoints) {
  EXPECT_NEAR(budget_of(find_vehicle("roof_pandar64")).typical.work.turn_points, 0.4 * 64 * 1'800,
              4'000);
  EXPECT_DOUBLE_EQ(budget_of(find_vehicle("roof_os1_64")).typical.work.turn_points,
                   0.4 * 64 * 1'024);
}

// 32 rows in 1,024 directions, each twice.
TEST(Budget, OfAnOusterWithTwoReturnsTheSecondIsALaterEcho) {
  const FrameWork work = budget_of(find_vehicle("roof_os0_32_dual")).worst.work;
  EXPECT_EQ(work.points_once, 32 * 1'024);
  EXPECT_EQ(work.later_echoes, 32 * 1'024);
}

// 800 detections; 23 ticks to either side, in steps of 2 at 73 m and of 5 at half of that.
TEST(Budget, OfARadarTheStepsOfItsArcsCount) {
  const VehicleBudget budget = budget_of(find_vehicle("roof_vlp16_radar"));
  CatalogueEntry roof = find_vehicle("roof_vlp16");
  const vehicle::Vehicle its = of_indexes(roof);
  roof.vehicle = &its;
  const VehicleBudget without = budget_of(roof);
  EXPECT_EQ(budget.worst.work.arc_steps, 800 * 23);
  EXPECT_EQ(budget.typical.work.arc_steps, 800 * 9);
  EXPECT_EQ(budget.worst.work.points_once, without.worst.work.points_once);
  EXPECT_EQ(budget.typical.work.turn_points, without.typical.work.turn_points);
  EXPECT_GT(budget.typical.ms, without.typical.ms);
}

// Four units of 5 m, 719 ticks to either side, in steps of 36 and of 73; of their cones twice 52 by
// 52 cells and 27 by 27.
TEST(Budget, OfAnUltrasonicUnitTheCellsOfItsConeCount) {
  const VehicleBudget budget = budget_of(find_vehicle("roof_vlp16_ultrasonic"));
  EXPECT_EQ(budget.worst.work.arc_steps, 4 * (1 + 2 * 19));
  EXPECT_EQ(budget.typical.work.arc_steps, 4 * (1 + 2 * 9));
  EXPECT_EQ(budget.worst.work.cone_cells, 4 * 2 * 52 * 52);
  EXPECT_EQ(budget.typical.work.cone_cells, 4 * 2 * 27 * 27);
  EXPECT_EQ(budget_of(find_vehicle("roof_vlp16_radar")).worst.work.cone_cells, 0);
}

// docs/results/four_cores.md: the city's frame takes 0.67, 0.46, 0.39 of one core's time.
TEST(Budget, TakesTheFewestCoresThatAreEnough) {
  EXPECT_EQ(cores_for(39.9, 40), 1U);
  EXPECT_EQ(cores_for(50, 40), 2U);
  EXPECT_EQ(cores_for(76, 40), 3U);
  EXPECT_EQ(cores_for(96, 40), 4U);
  EXPECT_EQ(cores_for(110, 40), 0U);
}

TEST(Budget, SaysOnHowManyCoresACarHasItsPeriod) {
  for (const CatalogueEntry& car : all_vehicles()) {
    const VehicleBudget budget = budget_of(car);
    const bool is_held = budget.worst.ms * kShareOfCores.back() <= budget.period_ms;
    EXPECT_EQ(line_of_cores(car).find("not on 4 cores") == std::string::npos, is_held)
        << line_of_cores(car);
  }
}

TEST(Budget, SaysThatItIsModelledAndOfWhichData) {
  const std::string words = words_of_budget_errors();
  EXPECT_NE(words.find("Modelled, not measured"), std::string::npos);
  EXPECT_NE(words.find("lab/data/cortex_a9.csv"), std::string::npos);
  for (const CatalogueEntry& car : all_vehicles()) {
    const VehicleBudget budget = budget_of(car);
    EXPECT_LT(budget.typical.ms, budget.worst.ms);
    const bool is_too_slow = budget.worst.ms > budget.period_ms;
    EXPECT_EQ(words_of_budget(car).find("TOO SLOW") != std::string::npos, is_too_slow)
        << words_of_budget(car);
  }
}

}  // namespace
}  // namespace iog::tools
