// scaling: what a frame costs the Cortex-A9 as the load grows. Makes its frames itself, so that no
// scene is in the way: LUX around a car, all beams of about one range. Prints one line of key=value
// pairs, means over the frames; in QEMU's cost model (lab/target/measure_a9) its stages are those
// of frame_cost. The grid is that of the build, IOG_CELLS_PER_SIDE and IOG_CELL_MM.
//
//   scaling <sensors> <directions of a layer> <range in cm> <frames>
//
// One frame more goes before, to warm up.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>

#include "instruction_counter.hpp"
#include "lab/a9_model/marker.hpp"
#include "number_in.hpp"
#include "stage_pass.hpp"
#include "synthetic_scan.hpp"
#include "tools/car/scanners.hpp"
#include "tools/car/tables.hpp"

namespace iog::lab {
namespace {

// What the walk's error term leaves room for (src/car_block/limits.cpp), and the core's own limit.
constexpr std::uint32_t kLongMm = std::min<std::uint32_t>(
    100'000, std::uint32_t{geometry::kCellMm} * 1400 * 1024 / std::uint32_t{geometry::kResolution});
constexpr std::uint32_t kUsualMm = 50'000;

constexpr std::uint16_t kFirstPort = 12'002;

// At the car's corners and sides, an eighth of a turn apart.
description::SensorConfig sensor_config(std::size_t i, std::uint32_t range_mm) {
  constexpr std::array<std::array<double, 2>, 8> kPlaces{
      {{2.05, 0}, {-2.05, 0}, {0, 0.9}, {0, -0.9}, {2, 0.8}, {2, -0.8}, {-2, 0.8}, {-2, -0.8}}};
  constexpr std::array<double, 8> kYawsDeg{0, 180, 90, -90, 45, -45, 135, -135};
  description::SensorConfig config = description::scanner_of(lidar::kFormat<lidar::IbeoLux>);
  config.name = "lux";
  config.udp_port = static_cast<std::uint16_t>(kFirstPort + i);
  config.mount = {.x_m = kPlaces[i][0], .y_m = kPlaces[i][1], .z_m = 0.5, .yaw_deg = kYawsDeg[i]};
  config.max_points_per_scan = kMostAzimuths * lidar::IbeoLux::points_of_packet(4);
  config.range_max_mm = range_mm;
  return config;
}

// The height band cuts nothing off.
constexpr description::Description kDescription{
    .name = "scaling",
    .footprint = {.x_min_m = -2.04, .x_max_m = 2.04, .y_min_m = -0.87, .y_max_m = 0.87},
    .z_min_m = -10,
    .z_max_m = 10,
};

// Of so many sensors; called once.
vehicle::Vehicle vehicle_with(std::uint32_t sensors, std::uint32_t range_mm) {
  static std::array<vehicle::Sensor, vehicle::kMaxSensors> all;
  for (std::size_t i = 0; i < sensors; ++i) {
    all[i] = description::sensor_of(sensor_config(i, range_mm), kDescription);
  }
  return description::vehicle_of(kDescription, std::span(all).first(sensors));
}

struct Request {
  std::uint32_t sensors = 0;
  Fan fan;
  std::uint32_t frames = 0;
};

void drive(const Request& request, const vehicle::Vehicle& vehicle, StagePass& stages) {
  static SyntheticScan scan;
  std::uint64_t now_us = 0;
  for (std::uint32_t frame = 0; frame <= request.frames; ++frame) {
    for (std::uint32_t sensor = 0; sensor < request.sensors; ++sensor) {
      for (std::uint32_t i = 0; i < SyntheticScan::messages(request.fan); ++i) {
        stages.take(vehicle.sensors[sensor],
                    {.source_ipv4 = kReplayer,
                     .destination_port = vehicle.sensors[sensor].udp_port,
                     .payload = scan.write(request.fan, sensor, frame, i)},
                    0, now_us);
      }
    }
    now_us += vehicle.frame_period_us;
    if (frame == 0) {
      a9_model::forget_so_far();
    }
  }
  stages.tick(stages.deadline_us());  // says what publishing the last one cost
}

void print(const char* key, std::uint64_t value) {
  // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned long
  std::printf(" %s=%llu", key, value);
}

int run(const Request& request) {
  static InstructionCounter counter;
  static const vehicle::Vehicle vehicle =
      vehicle_with(request.sensors, request.fan.range_cm * 10 <= kUsualMm ? kUsualMm : kLongMm);
  static StagePass stages(vehicle, counter, app::Coding::kRaw);
  counter.start();
  if (!counter.is_exact()) {
    std::puts("scaling: instructions are not counted; is this -icount shift=4,sleep=off?");
    return 1;
  }
  drive(request, vehicle, stages);
  const std::uint64_t frames = stages.frames();
  if (frames != request.frames + 1) {
    std::puts("scaling: a frame is missing");
    return 1;
  }
  std::printf("scaling");
  print("cells_per_side", geometry::kCellsPerSide);
  print("cell_mm", geometry::kCellMm);
  print("sensors", request.sensors);
  print("azimuths", request.fan.azimuths);
  print("range_cm", request.fan.range_cm);
  print("frames", request.frames);
  print("points", stages.points() / frames);
  print("points_used", stages.points_used() / frames);
  print("messages", stages.platform().messages() / frames);
  std::puts("");
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main(int argc, char** argv) {
  using iog::lab::number_in;
  iog::lab::Request request;
  if (argc == 5) {
    request = {.sensors = number_in(argv[1], iog::vehicle::kMaxSensors),
               .fan = {.azimuths = number_in(argv[2], iog::lab::kMostAzimuths),
                       .range_cm = number_in(argv[3], iog::lab::kLongMm / 10)},
               .frames = number_in(argv[4], 1'000)};
  }
  if (request.sensors == 0 || request.fan.azimuths < 2 || 3200 % (request.fan.azimuths - 1) != 0 ||
      request.fan.range_cm < 400 || request.frames == 0) {
    std::puts(
        "scaling: expected sensors, directions of a layer, a range of 400 cm at least and "
        "frames, within the limits of the core");
    return 2;
  }
  return iog::lab::run(request);
}
