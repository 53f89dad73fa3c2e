// Which descriptions ask for what no target can do, told by their field. All that the file of a car
// can have wrong is in tests/host/vehicles/mistakes.txt.
#include "tools/car/limits.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

#include "car_block/limits.hpp"
#include "tools/car/scanners.hpp"
#include "tools/car/tables.hpp"

namespace iog::description {
namespace {

using vehicle::Grids;

constexpr net::Config kNetwork{.mac = {{2, 0, 0, 0, 0, 1}},
                               .address = net::ipv4(10, 0, 2, 15),
                               .prefix_bits = 24,
                               .peer = net::ipv4(10, 0, 2, 2),
                               .peer_port = 1,
                               .source_port = 2};

// With as many azimuth steps as given; 0 are those of the default.
SensorConfig turning(std::uint32_t steps, double pitch_deg = 0) {
  static std::uint16_t port = 2368;
  static const std::vector<std::string> names{"a", "b", "c", "d", "e", "f", "g", "h"};
  SensorConfig config = scanner_of(lidar::kFormat<lidar::VelodyneVlp16>);
  config.name = names[port % names.size()];
  config.udp_port = port++;
  config.mount = {.z_m = 1.5, .pitch_deg = pitch_deg};
  config.max_points_per_scan = 384;
  config.azimuth_steps_per_turn = steps;
  return config;
}

SensorConfig on_port_100() {
  SensorConfig config = turning(0);
  config.udp_port = 100;
  return config;
}

// The fields that are told, with a blank between two; of a sensor with its number. As a car's file
// is looked at.
std::string faults_of(const Description& car,
                      const std::vector<SensorConfig>& configs = {on_port_100()}) {
  std::string told;
  auto listen = [&](const vehicle::Fault& fault) {
    told += told.empty() ? "" : " ";
    told += fault.sensor == vehicle::Fault::kCar ? "" : std::to_string(fault.sensor) + ".";
    told += fault.field;
  };
  const vehicle::Tell tell(listen);
  check(car, configs, tell);
  std::vector<vehicle::Sensor> sensors;
  for (const SensorConfig& config : configs) {
    sensors.push_back(numbers_of(config));
  }
  car_block::check_numbers(numbers_of(car, sensors), kNetwork, tell);
  if (told.empty()) {
    for (std::size_t i = 0; i < configs.size(); ++i) {
      sensors[i] = sensor_of(configs[i], car);
    }
    car_block::check_tables(vehicle_of(car, sensors), tell);
  }
  return told;
}

Description described(Grids grids) { return {.name = "a_car", .grids = grids}; }

std::string faults_with(Grids grids, auto&& change) {
  Description car = described(grids);
  change(car);
  return faults_of(car);
}

TEST(DescriptionLimits, ClassesNeedHitsWinAndBlurring) {
  const auto bayes = [](Description& car) { car.rule = vehicle::FusionRule::kBayes; };
  const auto nearest = [](Description& car) { car.quantisation = index::Quantisation::kNearest; };
  EXPECT_EQ(faults_of(described(Grids::kBoth)), "");
  EXPECT_EQ(faults_of(described(Grids::kClasses)), "");
  EXPECT_EQ(faults_with(Grids::kIndexes, bayes), "");
  EXPECT_EQ(faults_with(Grids::kClasses, bayes), "rule");
  EXPECT_EQ(faults_with(Grids::kIndexes, nearest), "");
  EXPECT_EQ(faults_with(Grids::kBoth, nearest), "quantisation");
}

TEST(DescriptionLimits, PosesNeedAPortOfTheirOwnAndShortSlices) {
  const auto shared = [](Description& car) { car.poses = {.udp_port = 100}; };
  EXPECT_EQ(faults_with(Grids::kBoth, shared), "poses.udp_port");
  EXPECT_EQ(faults_with(Grids::kIndexes, shared), "");
  EXPECT_EQ(faults_with(Grids::kBoth, [](auto& car) { car.poses = {.log2_slice_ms = 7}; }),
            "poses.log2_slice_ms");
  EXPECT_EQ(faults_with(Grids::kBoth, [](auto& car) { car.poses = {.udp_port = 0}; }),
            "poses.udp_port");
}

TEST(DescriptionLimits, MapsNeedAPortOfTheirOwn) {
  const auto faults_on = [](Grids grids, std::uint16_t udp_port) {
    return faults_with(grids, [&](Description& car) { car.maps.udp_port = udp_port; });
  };
  EXPECT_EQ(faults_on(Grids::kBoth, 100), "maps.udp_port");
  EXPECT_EQ(faults_on(Grids::kBoth, pose::kPosePort), "maps.udp_port");
  EXPECT_EQ(faults_on(Grids::kBoth, 0), "maps.udp_port");
  EXPECT_EQ(faults_on(Grids::kIndexes, 100), "");
}

std::string faults_of_grid(const GridConfig& grid) {
  Description car = described(Grids::kIndexes);
  car.grid = grid;
  SensorConfig config = on_port_100();
  config.range_max_mm = 40'000;
  return faults_of(car, {config});
}

// docs/vehicles.md: 32 ... 4096 cells of 0.05, 0.1, 0.2 or 0.5 m, wherever the car is in them.
TEST(DescriptionLimits, AGridOfTheLongestSideMayLieOnOneSideOfTheCar) {
  for (const double cell_m : {0.05, 0.1, 0.2, 0.5}) {
    for (const double share : {0.0, 0.25, 1.0}) {
      const double first_m = share * 4096 * cell_m;
      const double second_m = (1 - share) * 4096 * cell_m;
      const double short_m = 128 * cell_m;
      EXPECT_EQ(faults_of_grid({cell_m, first_m, second_m, short_m, short_m}), "");
      EXPECT_EQ(faults_of_grid({cell_m, short_m, short_m, first_m, second_m}), "");
    }
  }
}

// Its side and its cells are too many, though 66,560 columns are 1,024 in a number of 16 bits.
TEST(DescriptionLimits, AGridOfMoreCellsThanItsNumbersHoldIsNotShort) {
  const std::string both = "grid.ahead_m grid.ahead_m";
  EXPECT_EQ(faults_of_grid({.cell_m = 0.05, .ahead_m = 1280, .behind_m = 2048}), both);
  EXPECT_EQ(faults_of_grid({.cell_m = 0.05, .ahead_m = 2048, .behind_m = 25.6}), both);
}

std::string faults_in_steps(std::uint32_t steps) {
  return faults_of(described(Grids::kIndexes), {turning(steps, 1)});
}

TEST(DescriptionLimits, AnAzimuthStepIsAPowerOfTwoOfATurn) {
  EXPECT_EQ(faults_in_steps(0), "");
  EXPECT_EQ(faults_in_steps(256), "");
  EXPECT_EQ(faults_in_steps(16'384), "");
  EXPECT_EQ(faults_in_steps(128), "0.azimuth_steps_per_turn");
  EXPECT_EQ(faults_in_steps(3'000), "0.azimuth_steps_per_turn");
  EXPECT_EQ(faults_in_steps(32'768), "0.azimuth_steps_per_turn");
}

// What no car is as large as, and what is no number.
TEST(DescriptionLimits, ACarLiesBetweenTheEndsOfItsWorld) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  const auto faults = [](auto&& change) { return faults_with(Grids::kIndexes, change); };
  for (const double wrong : {-1'000.1, -kEndless, kNone}) {
    EXPECT_EQ(faults([&](Description& car) { car.z_min_m = wrong; }), "z_min_m");
    EXPECT_EQ(faults([&](Description& car) { car.footprint.x_min_m = wrong; }),
              "footprint.x_min_m");
    EXPECT_EQ(faults([&](Description& car) { car.footprint.y_min_m = wrong; }),
              "footprint.y_min_m");
  }
  for (const double wrong : {1'000.1, kEndless}) {
    EXPECT_EQ(faults([&](Description& car) { car.z_max_m = wrong; }), "z_max_m");
    EXPECT_EQ(faults([&](Description& car) { car.footprint.x_max_m = wrong; }),
              "footprint.x_min_m");
    EXPECT_EQ(faults([&](Description& car) { car.footprint.y_max_m = wrong; }),
              "footprint.y_min_m");
  }
  EXPECT_EQ(faults([](Description& car) { car.z_max_m = car.z_min_m; }), "z_min_m");
  EXPECT_EQ(faults([](Description& car) {
              car.z_min_m = -1'000;
              car.z_max_m = 1'000;
            }),
            "");
}

TEST(DescriptionLimits, ASensorWithoutARangeIsNone) {
  SensorConfig config = on_port_100();
  config.range_max_mm = 0;
  config.range_min_mm = 0;
  EXPECT_EQ(faults_of(described(Grids::kIndexes), {config}), "0.range_max_mm");
}

// docs/model.md 4: a 1D cell is between a quarter and four of the deviation.
TEST(DescriptionLimits, ACellIsAboutAsLongAsTheDeviation) {
  const auto faults = [](std::uint32_t precision_mm, double sigma_m) {
    SensorConfig config = on_port_100();
    config.precision_mm = precision_mm;
    config.sigma_m = sigma_m;
    return faults_of(described(Grids::kIndexes), {config});
  };
  EXPECT_EQ(faults(24, 0.1), "0.precision_mm");
  EXPECT_EQ(faults(100, 0.1), "");
  EXPECT_EQ(faults(401, 0.1), "0.precision_mm");
  EXPECT_EQ(faults(100, 1.01), "0.sigma_m");
}

// docs/vehicles.md: low_m 0.1 ... 10, tall_m 0 ... 10; the tables ask for more by what is an
// obstacle.
TEST(DescriptionLimits, HeightsThatOpenGroundAreThoseOfThings) {
  const auto faults = [](MovedConfig moved) {
    SensorConfig config = on_port_100();
    config.moved = moved;
    const std::string told = faults_of(described(Grids::kIndexes), {config});
    return told.substr(0, told.find(' '));
  };
  EXPECT_EQ(faults({.low_m = 0.6, .tall_m = 0.7}), "");
  EXPECT_EQ(faults({.low_m = 0.09, .tall_m = 0.7}), "0.moved.low_m");
  EXPECT_EQ(faults({.low_m = 10.1, .tall_m = 0.7}), "0.moved.low_m");
  EXPECT_EQ(faults({.low_m = 1e300, .tall_m = 0.7}), "0.moved.low_m") << "not taken for none";
  EXPECT_EQ(faults({.low_m = 0.6, .tall_m = -0.1}), "0.moved.tall_m");
  EXPECT_EQ(faults({.low_m = 0.6, .tall_m = 10.1}), "0.moved.tall_m");
}

// 20 m of a VLP-16 at 10 m: its lowest beam, of -15 degrees, comes down to 4.8 m. Tilted by 30
// degrees to whichever side it comes to the ground.
TEST(DescriptionLimits, SomeBeamMeetsTheBand) {
  const auto faults = [](double pitch_deg, double roll_deg) {
    SensorConfig config = on_port_100();
    config.range_max_mm = 20'000;
    config.mount.z_m = 10;
    config.mount.pitch_deg = pitch_deg;
    config.mount.roll_deg = roll_deg;
    return faults_of(described(Grids::kIndexes), {config});
  };
  EXPECT_EQ(faults(0, 0), "0.mount.z_m");
  for (const double tilt_deg : {-30.0, 30.0}) {
    EXPECT_EQ(faults(tilt_deg, 0), "");
    EXPECT_EQ(faults(0, tilt_deg), "");
  }
}

// A laser that looks up from far below has its beam beside the car.
TEST(DescriptionLimits, ALaserIsWithinReachOfItsUnit) {
  const auto faults = [](const lidar::Laser& laser) {
    SensorConfig config = on_port_100();
    const std::vector<lidar::Laser> lasers(16, laser);
    config.lasers = lasers;
    const std::string told = faults_of(described(Grids::kIndexes), {config});
    return told.substr(0, told.find(' '));
  };
  EXPECT_EQ(faults({.elevation_deg = 5, .azimuth_deg = 30, .height_m = 0.1, .range_m = 10}), "");
  EXPECT_EQ(faults({.elevation_deg = 89.1}), "0.lasers");
  EXPECT_EQ(faults({.elevation_deg = 5, .azimuth_deg = -30.1}), "0.lasers");
  EXPECT_EQ(faults({.elevation_deg = 5, .height_m = -10.1}), "0.lasers");
  EXPECT_EQ(faults({.elevation_deg = 5, .range_m = 10.1}), "0.lasers");
  EXPECT_EQ(faults({.elevation_deg = 80, .height_m = 2}), "0.lasers") << "2 m tan(80) are 11.3 m";
}

// 8,192 lines are kept. Of a sensor that is tilted none are.
TEST(DescriptionLimits, SensorsThatTurnHaveAsManyLinesAsAreKept) {
  const auto faults = [](const std::vector<SensorConfig>& sensors) {
    return faults_of(described(Grids::kIndexes), sensors);
  };
  EXPECT_EQ(faults({turning(8'192)}), "");
  EXPECT_EQ(faults({turning(4'096), turning(4'096)}), "");
  EXPECT_EQ(faults({turning(8'192), turning(8'192, 2)}), "");
  EXPECT_EQ(faults({turning(4'096), turning(4'096), turning(256)}), "2.azimuth_steps_per_turn");
  EXPECT_EQ(faults({turning(16'384)}), "0.azimuth_steps_per_turn");
}

// What the target is told of classes is what the description says.
TEST(DescriptionLimits, ItsRulesReachTheTarget) {
  Description car = described(Grids::kClasses);
  car.poses = {.source_ipv4 = 7, .udp_port = 9, .log2_slice_ms = 2};
  car.window.moved = perception::Moved::kLiteral;
  car.window.assignment = &evidence::kReinforced;
  const vehicle::Vehicle vehicle = vehicle_of(car, {});
  EXPECT_EQ(vehicle.grids, Grids::kClasses);
  EXPECT_EQ(vehicle.poses.source_ipv4, 7U);
  EXPECT_EQ(vehicle.poses.udp_port, 9);
  EXPECT_EQ(vehicle.poses.log2_slice_ms, 2);
  EXPECT_EQ(vehicle.window.moved, perception::Moved::kLiteral);
  EXPECT_EQ(vehicle.window.assignment, &evidence::kReinforced);
}

// Every one of them is a car's, as it stands.
TEST(DescriptionLimits, WhatADataSheetSaysIsAllowed) {
  for (const ScannerType& type : kScannerTypes) {
    SensorConfig config = scanner_of(type.format);
    config.name = "roof";
    config.udp_port = 1;
    config.mount.z_m = 1;
    config.max_points_per_scan = std::max<std::uint32_t>(config.max_points_per_scan, 3'000);
    const lidar::ScannerFacts facts = lidar::facts_of(type.format);
    std::vector<lidar::Laser> lasers(facts.layers == 0 ? 16 : facts.layers);
    for (std::size_t i = 0; i < lasers.size(); ++i) {
      lasers[i].elevation_deg = 0.1 * static_cast<double>(i);  // those of points rise
    }
    config.lasers = facts.has_elevations ? std::span<const lidar::Laser>() : lasers;
    config.mode = facts.has_modes ? lidar::kTurnModes[0] : lidar::TurnMode{};
    config.beam_tilt_deg = facts.has_beam_tilt ? 1.6 : 0;
    EXPECT_EQ(faults_of(described(Grids::kIndexes), {config}), "") << type.name;
  }
}

}  // namespace
}  // namespace iog::description
