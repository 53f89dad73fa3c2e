// Units that turn, with classes: frames are shorter than turns, and nothing of a turn is lost.
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <string>

#include "fakes/temporary_folder.hpp"
#include "lidar/formats.hpp"
#include "pose/message.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/simulate/drives/drive.hpp"

namespace iog::tools {
namespace {

constexpr std::uint32_t kPeriodUs = 40'000;

// What a target with classes makes of some turns while its car stands and says so.
struct Fused {
  std::uint64_t sent = 0;
  std::uint64_t packets = 0;
  std::uint64_t packets_placed = 0;
  std::uint64_t frames = 0;
  std::uint32_t dropped = 0;
};

CapturedDatagram pose_at(std::uint64_t time_us, pose::Encoder& encoder) {
  constexpr std::uint64_t kClockStartUs = 1'700'000'000'000'000;
  const auto bytes = encoder.encode(
      {.run = 1, .age_us = 0, .clock_us = kClockStartUs + time_us, .sigma = {10, 10}});
  CapturedDatagram datagram;
  datagram.time_us = time_us;
  datagram.destination.port = pose::kPosePort;
  datagram.payload.assign(bytes.begin(), bytes.end());
  return datagram;
}

Fused fuse_turns(const CatalogueEntry& car, std::uint32_t tenths) {
  vehicle::Vehicle vehicle = *car.vehicle;
  vehicle.grids = vehicle::Grids::kBoth;
  vehicle.frame_period_us = kPeriodUs;
  Fused fused;
  FrameAssembler assembler([&](GridFrame&& frame) {
    fused.packets += frame.header.packets_fused;
    fused.frames += frame.header.packets_fused > 0 ? 1U : 0U;
    fused.dropped = frame.header.packets_dropped;
    fused.packets_placed += frame.classes ? frame.classes->end.packets_placed : 0;
  });
  const auto target = std::make_unique<OfflineTarget>(
      vehicle, [&](std::span<const std::byte> message) { assembler.take(message); });
  Drive drive(car, 1, 1);
  pose::Encoder poses;
  std::uint64_t next_pose_us = 0;
  for (std::uint32_t tenth = 0; tenth < tenths; ++tenth) {
    for (const CapturedDatagram& datagram : drive.datagrams(tenth)) {
      for (next_pose_us = std::max(next_pose_us, datagram.time_us - datagram.time_us % 10'000);
           next_pose_us <= datagram.time_us; next_pose_us += 10'000) {
        static_cast<void>(target->take(pose_at(next_pose_us, poses)));
      }
      static_cast<void>(target->take(datagram));
      ++fused.sent;
    }
  }
  target->finish();
  assembler.finish();
  return fused;
}

void expect_nothing_lost(const CatalogueEntry& car) {
  // The first two packets of an HDL-64E do not tell yet whose they are (docs/spec.md, 1.2).
  constexpr std::uint32_t kInDoubt = 2;
  const Fused fused = fuse_turns(car, 3);
  EXPECT_GT(fused.sent, 30U) << car.vehicle->name;
  EXPECT_EQ(fused.packets + fused.dropped, fused.sent) << car.vehicle->name;
  EXPECT_LE(fused.dropped, car.vehicle->name.starts_with("roof_hdl64e") ? kInDoubt : 0)
      << car.vehicle->name;
  // 40 ms each, from the first packet of one to that of the next.
  EXPECT_GE(fused.frames, 7U) << car.vehicle->name;
  EXPECT_LE(fused.frames, 9U) << car.vehicle->name;
  EXPECT_GT(fused.packets_placed, fused.packets * 8 / 10) << car.vehicle->name;
}

TEST(DenseClasses, NothingOfATurnIsLost) {
  int cars = 0;
  for (const CatalogueEntry& car : all_vehicles()) {
    const bool all_turn =
        std::ranges::all_of(car.vehicle->sensors, &lidar::turns, &vehicle::Sensor::format);
    if (all_turn) {
      expect_nothing_lost(car);
      ++cars;
    }
  }
  EXPECT_GE(cars, 7);
}

// A car with level Ousters, side by side on its roof: rows from 20 degrees above the horizon to
// 20 below, by turns to the sides as in an OS1.
std::string file_of_ousters(const std::string& name, int units, int rows, const std::string& mode) {
  std::string text = "name = \"" + name +
                     "\"\nz_min_m = 0.3\nz_max_m = 2.2\nframe_period_us = 40_000\n"
                     "footprint = { x_min_m = -2.2, x_max_m = 2.2, y_min_m = -0.9, y_max_m = 0.9 "
                     "}\n";
  const std::string points = std::to_string(std::stoi(mode.substr(0, mode.find('x'))) * rows);
  for (int unit = 0; unit < units; ++unit) {
    text.append("\n[[sensors]]\nname = \"roof" + std::to_string(unit))
        .append("\"\ntype = \"ouster_legacy\"\nudp_port = " + std::to_string(7'502 + unit))
        .append("\nmount = { x_m = 0, y_m = " + std::to_string(unit) + ", z_m = 1.8 }\n")
        .append("ground = false\nazimuth_steps_per_turn = 4096\nmax_points_per_scan = " + points)
        .append("\nmode = \"" + mode + "\"\nlasers = [\n");
    for (int row = 0; row < rows; ++row) {
      text += "  { elevation_deg = " + std::to_string(20.0 - 40.0 * row / (rows - 1)) +
              ", azimuth_deg = " + std::to_string(row % 4 * 2.1 - 3.1) +
              ", height_m = 0, range_m = 0 },\n";
    }
    text += "]\n";
  }
  return text;
}

struct Ousters {
  const char* name;
  int units;
  int rows;
  const char* mode;
};

class DenseOusters : public ::testing::TestWithParam<Ousters> {};

TEST_P(DenseOusters, LoseNothingOfATurn) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / (std::string(GetParam().name) + ".toml");
  std::ofstream(path) << file_of_ousters(GetParam().name, GetParam().units, GetParam().rows,
                                         GetParam().mode);
  expect_nothing_lost(find_vehicle(add_vehicle_file(path)));
}

INSTANTIATE_TEST_SUITE_P(OfManyLayers, DenseOusters,
                         ::testing::Values(Ousters{"os1_128", 1, 128, "1024x10"},
                                           Ousters{"os1_128_fine", 1, 128, "2048x10"},
                                           Ousters{"os1_128_fast", 1, 128, "1024x20"},
                                           Ousters{"two_os1_64", 2, 64, "2048x10"},
                                           Ousters{"two_os1_64_fast", 2, 64, "1024x20"}));

}  // namespace
}  // namespace iog::tools
