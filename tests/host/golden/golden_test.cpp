// docs/model.md section 7: one capture, one grid hash, wherever the code runs. The capture is made
// here from integers alone, so that every machine makes the same bytes; this test is built by gcc
// and clang for the PC and by gcc for the Cortex-A9, and the hash below is asserted by all of them.
//
// That the cells are right is shown by grid/sampling_test.cpp; this shows that they are the same.
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "app/pipeline.hpp"
#include "fakes/fake_platform.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/random.hpp"
#include "fakes/vlp16_packet.hpp"
#include "vehicles/reference_car.hpp"
#include "vehicles/roof_vlp16.hpp"

namespace iog {
namespace {

constexpr std::uint32_t kReplayer = 1;

std::uint32_t name_of_run(const std::vector<tests::ReceivedFrame>& frames) {
  stream::Crc32 run;
  for (const tests::ReceivedFrame& frame : frames) {
    std::array<std::byte, 4> crc{};
    wire::store_be32(crc, frame.end.grid_crc);
    run.update(crc);
  }
  return run.value();
}

// A wall that comes nearer and turns with the azimuth, with gaps, ground, rain and second echoes.
tests::LuxMessage wall(int scan, int sensor, tests::Random& random) {
  tests::LuxMessage message{.scan_number = scan};
  for (int azimuth = 1600; azimuth >= -1600; azimuth -= 16) {
    for (int layer = 0; layer < 4; ++layer) {
      const int range_cm = 800 + 300 * sensor + (azimuth + 1600) * (3 + layer) / 4 - 20 * scan +
                           random.between(-8, 8);
      const int flags = random.one_in(40) ? 2 : (layer == 0 && random.one_in(5) ? 4 : 0);
      if (!random.one_in(25)) {
        message.points.push_back({layer, 0, flags, azimuth, range_cm});
      }
      if (random.one_in(30)) {
        message.points.push_back({layer, 1, 0, azimuth, range_cm + 700});
      }
    }
  }
  return message;
}

TEST(Golden, FourLuxHaveOneNameEverywhere) {
  tests::Random random(2017);
  tests::FakePlatform platform;
  const auto pipeline = std::make_unique<app::Pipeline<tests::FakePlatform>>(
      vehicles::reference_car::kVehicle, kReplayer, platform, std::uint64_t{0});
  for (int scan = 1; scan <= 3; ++scan) {
    for (int sensor = 0; sensor < 4; ++sensor) {
      const auto bytes = wall(scan, sensor, random).bytes();
      const auto port = static_cast<std::uint16_t>(12'002 + sensor);
      pipeline->take({kReplayer, port, bytes}, static_cast<std::uint64_t>(scan) * 40'000);
    }
  }
  ASSERT_EQ(platform.frames.size(), 3U);
  EXPECT_EQ(name_of_run(platform.frames), 0x04E7E467U);
}

TEST(Golden, AVlp16HasOneNameEverywhere) {
  tests::Random random(2017);
  tests::FakePlatform platform;
  const auto pipeline = std::make_unique<app::Pipeline<tests::FakePlatform>>(
      vehicles::roof_vlp16::kVehicle, kReplayer, platform, std::uint64_t{0});
  for (int number = 0; number < 76; ++number) {
    tests::Vlp16Packet packet{.first_azimuth = number * 478 % 36'000,
                              .time_us = static_cast<std::uint32_t>(number) * 1327};
    for (auto& block : packet.ranges) {
      for (int& range : block) {
        range = random.one_in(6) ? 0 : random.between(600, 20'000);
      }
    }
    pipeline->take({kReplayer, 2368, packet.bytes()}, static_cast<std::uint64_t>(number) * 1327);
  }
  ASSERT_EQ(platform.frames.size(), 1U);
  EXPECT_EQ(name_of_run(platform.frames), 0xC322BA0FU);
}

}  // namespace
}  // namespace iog
