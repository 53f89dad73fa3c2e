// Vehicles for tests, chosen so that what must happen can be worked out by hand. Their tables are
// computed when a test program starts.
#pragma once

#include <array>

#include "car_block/limits.hpp"
#include "tools/car/scanners.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tests {

constexpr description::SensorConfig test_lux(std::uint16_t port,
                                             const description::MountConfig& mount) {
  description::SensorConfig config = description::scanner_of(lidar::kFormat<lidar::IbeoLux>);
  config.name = "lux";
  config.source_ipv4 = 0x0A000200U + port;
  config.udp_port = port;
  config.mount = mount;
  config.max_points_per_scan = 201 * lidar::IbeoLux::points_of_packet(4);
  return config;
}

// One LUX in the middle of the grid, on a cell's corner, with a height band that everything is in.
struct OneLux {
  static constexpr std::array kConfigs{test_lux(100, {})};
  static constexpr description::Description kDescription{
      .name = "one_lux", .z_min_m = -100, .z_max_m = 100};
  static const vehicle::Vehicle kVehicle;
};

// One LUX on a cell's corner, pitched so that its layer 2 runs level: 1D cells and the 2D cells
// ahead share their borders exactly.
struct LevelLux {
  static constexpr std::array kConfigs{test_lux(100, {.pitch_deg = 0.4})};
  static const vehicle::Vehicle kVehicle;
};

// One LUX at the height of a bumper, on a cell's border and in the middle of a row, and a band that
// begins below it.
struct BumperLux {
  static constexpr std::array kConfigs{test_lux(100, {.y_m = 0.05, .z_m = 0.42})};
  static constexpr description::Description kDescription{
      .name = "bumper_lux", .z_min_m = 0.2, .z_max_m = 2.2};
  static const vehicle::Vehicle kVehicle;
};

// One LUX in the middle of a cell.
struct MidCellLux {
  static constexpr std::array kConfigs{test_lux(100, {.x_m = 0.05, .y_m = 0.05})};
  static const vehicle::Vehicle kVehicle;
};

// OneLux with the other quantisation, in which the cell behind a hit is occupied too.
struct OneLuxNearest {
  static constexpr description::Description kDescription{
      .name = "one_lux_nearest",
      .z_min_m = -100,
      .z_max_m = 100,
      .quantisation = index::Quantisation::kNearest};
  static const vehicle::Vehicle kVehicle;
};

// One LUX off every border, turned, tilted and rolled, on a car with a footprint; it stands 0.5 m
// high and believes what lies between 0.2 and 1.5 m. A missing return clears 20 m.
struct TiltedLux {
  static constexpr std::array kConfigs{[] {
    auto config = test_lux(100, {.x_m = 1.234,
                                 .y_m = -0.777,
                                 .z_m = 0.5,
                                 .yaw_deg = 23.7,
                                 .pitch_deg = 1.9,
                                 .roll_deg = -2.3});
    config.no_return_clears_mm = 20'000;
    return config;
  }()};
  static constexpr description::Description kDescription{
      .name = "tilted_lux",
      .footprint = {.x_min_m = -1, .x_max_m = 1, .y_min_m = -1, .y_max_m = 1},
      .z_min_m = 0.2,
      .z_max_m = 1.5};
  static const vehicle::Vehicle kVehicle;
};

// Three LUX: two looking at the same place, one standing outside the grid and looking in.
struct ThreeLux {
  static constexpr std::array kConfigs{
      test_lux(100, {.x_m = 2.03, .y_m = 0.51, .z_m = 0.5, .yaw_deg = -5}),
      test_lux(101, {.x_m = 1.97, .y_m = -0.49, .z_m = 0.5, .yaw_deg = 7}),
      test_lux(102, {.x_m = 70.1, .y_m = 3.3, .z_m = 0.5, .yaw_deg = 180}),
  };
  static constexpr description::Description kDescription{
      .name = "three_lux", .z_min_m = -2, .z_max_m = 3};
  static const vehicle::Vehicle kVehicle;
};

constexpr description::SensorConfig test_vlp16(std::uint16_t port,
                                               const description::MountConfig& mount) {
  description::SensorConfig config = description::scanner_of(lidar::kFormat<lidar::VelodyneVlp16>);
  config.name = "vlp16";
  config.udp_port = port;
  config.mount = mount;
  config.no_return_clears_mm = 20'000;
  return config;
}

// One level VLP-16 off every border, turned, on a car with a footprint and a height band that cuts
// most of its layers.
struct LevelVlp16 {
  static constexpr std::array kConfigs{
      test_vlp16(100, {.x_m = 1.234, .y_m = -0.777, .z_m = 1.5, .yaw_deg = 23.7})};
  static constexpr description::Description kDescription{
      .name = "level_vlp16",
      .footprint = {.x_min_m = -3, .x_max_m = 2.5, .y_min_m = -2, .y_max_m = 2},
      .z_min_m = 0.3,
      .z_max_m = 2.2};
  static const vehicle::Vehicle kVehicle;
};

// A VLP-16 on a cell's corner, one that is pitched, and a LUX.
struct MixedCar {
  static constexpr std::array kConfigs{
      test_vlp16(100, {.z_m = 1.5}),
      test_vlp16(101, {.x_m = 1.02, .y_m = 0.71, .z_m = 1.2, .yaw_deg = 80, .pitch_deg = 11}),
      test_lux(102, {.x_m = 2.03, .y_m = 0.51, .z_m = 0.5, .yaw_deg = -5}),
  };
  static constexpr description::Description kDescription{
      .name = "mixed_car", .z_min_m = -2, .z_max_m = 3};
  static const vehicle::Vehicle kVehicle;
};

constexpr description::SensorConfig test_radar(std::uint16_t port,
                                               const description::MountConfig& mount) {
  description::SensorConfig config =
      description::scanner_of(lidar::kFormat<lidar::ContinentalArs548>);
  config.name = "radar";
  config.udp_port = port;
  config.mount = mount;
  return config;
}

// A VLP-16, and two radars off every border, one of them tilted, on a car with a footprint.
struct RadarCar {
  static constexpr std::array kConfigs{
      test_vlp16(100, {.z_m = 1.5}),
      test_radar(101, {.x_m = 2.03, .y_m = 0.51, .z_m = 0.6, .yaw_deg = 7}),
      test_radar(102, {.x_m = -2.07, .z_m = 0.7, .yaw_deg = 175, .pitch_deg = 3, .roll_deg = 31}),
  };
  static constexpr description::Description kDescription{
      .name = "radar_car",
      .footprint = {.x_min_m = -2.1, .x_max_m = 2.1, .y_min_m = -0.9, .y_max_m = 0.9},
      .z_min_m = 0.2,
      .z_max_m = 2.2};
  static const vehicle::Vehicle kVehicle;
};

// The same by the other rule.
struct BayesRadarCar {
  static constexpr description::Description kDescription = [] {
    description::Description car = RadarCar::kDescription;
    car.rule = vehicle::FusionRule::kBayes;
    return car;
  }();
  static const vehicle::Vehicle kVehicle;
};

// A radar that looks along the side of a bus.
struct RadarBus {
  static constexpr std::array kConfigs{test_radar(101, {.x_m = -9, .y_m = 1, .z_m = 0.6})};
  static constexpr description::Description kDescription{
      .name = "radar_bus",
      .footprint = {.x_min_m = -10, .x_max_m = 10, .y_min_m = -0.9, .y_max_m = 0.9},
      .z_min_m = 0.2,
      .z_max_m = 2.2};
  static const vehicle::Vehicle kVehicle;
};

constexpr description::SensorConfig test_ultrasonic(std::uint16_t port,
                                                    const description::MountConfig& mount,
                                                    double azimuth_sigma_deg = 15) {
  description::SensorConfig config =
      description::scanner_of(lidar::kFormat<lidar::MavlinkUltrasonic>);
  config.name = "ultrasonic";
  config.udp_port = port;
  config.azimuth_sigma_deg = azimuth_sigma_deg;
  config.mount = mount;
  return config;
}

// Five ultrasonic units off every border: to the front, over the rear left, the same upside down,
// to the right with the widest cone, and one that looks up.
struct UltrasonicCar {
  static constexpr std::array kConfigs{
      test_ultrasonic(101, {.x_m = 2.23, .y_m = 0.51, .z_m = 0.5}),
      test_ultrasonic(102, {.x_m = -2.17, .y_m = 0.33, .z_m = 0.6, .yaw_deg = 131}),
      test_ultrasonic(103,
                      {.x_m = -2.17, .y_m = 0.33, .z_m = 0.6, .yaw_deg = 131, .roll_deg = 180}),
      test_ultrasonic(104, {.x_m = 0.11, .y_m = -0.97, .z_m = 0.6, .yaw_deg = -93}, 20),
      test_ultrasonic(105, {.x_m = 2.23, .y_m = 0.51, .z_m = 0.5, .pitch_deg = -10}),
  };
  static constexpr description::Description kDescription{
      .name = "ultrasonic_car",
      .footprint = {.x_min_m = -2.1, .x_max_m = 2.1, .y_min_m = -0.9, .y_max_m = 0.9},
      .z_min_m = 0.2,
      .z_max_m = 2.2};
  static const vehicle::Vehicle kVehicle;
};

// Two VLP-16 with lines of 50 m, one above the height band and one beside the grid.
struct HighAndFar {
  static constexpr std::array kConfigs = [] {
    std::array configs{test_vlp16(100, {.z_m = 3}), test_vlp16(101, {.x_m = 62, .z_m = 1.5})};
    for (description::SensorConfig& config : configs) {
      config.range_max_mm = 50'000;
    }
    return configs;
  }();
  static constexpr description::Description kDescription{
      .name = "high_and_far", .z_min_m = 0.3, .z_max_m = 2.2};
  static const vehicle::Vehicle kVehicle;
};

consteval std::array<double, 128> elevations_of_many_layers() {
  std::array<double, 128> elevations{};
  for (std::size_t i = 0; i < elevations.size(); ++i) {
    elevations[i] = -25 + 50.0 * static_cast<double>(i) / 127;
  }
  return elevations;
}

template <std::size_t kCount>
constexpr std::array<lidar::Laser, kCount> lasers_at(
    const std::array<double, kCount>& elevations_deg) {
  std::array<lidar::Laser, kCount> lasers{};
  for (std::size_t i = 0; i < kCount; ++i) {
    lasers[i].elevation_deg = elevations_deg[i];
  }
  return lasers;
}

// A made-up lidar with 128 layers from -25 to 25 degrees, 50 m.
struct ManyLayers {
  static constexpr std::array<double, 128> kElevationsDeg = elevations_of_many_layers();
  static constexpr std::array kLasers = lasers_at(kElevationsDeg);
  static constexpr std::array kConfigs{[] {
    auto config = test_vlp16(100, {.x_m = 0.123, .y_m = 0.456, .z_m = 1.8});
    config.lasers = kLasers;
    config.range_max_mm = 50'000;
    config.precision_mm = 100;
    config.sigma_m = 0.10;
    return config;
  }()};
  static constexpr description::Description kDescription{
      .name = "many_layers", .z_min_m = 0.3, .z_max_m = 2.2};
  static const vehicle::Vehicle kVehicle;
};

// A level lidar that turns, with lines as long and beams as steep as a description may have them:
// they end up to 7.4 km over and under the grid.
struct SteepVlp16 {
  static constexpr std::array<double, 16> kElevationsDeg{-89, -85, -80, -45, -10, -2, -1, -0.5,
                                                         0.5, 1,   2,   10,  45,  80, 85, 89};
  static constexpr std::array kLasers = lasers_at(kElevationsDeg);
  static constexpr std::array kConfigs{[] {
    auto config = test_vlp16(100, {.x_m = 1.234, .y_m = -0.777, .z_m = 1.5, .yaw_deg = 23.7});
    config.range_max_mm = car_block::kLongestRangeMm;
    config.lasers = kLasers;
    return config;
  }()};
  static constexpr description::Description kDescription{
      .name = "steep_vlp16", .z_min_m = 0.3, .z_max_m = 2.2};
  static const vehicle::Vehicle kVehicle;
};

}  // namespace iog::tests
