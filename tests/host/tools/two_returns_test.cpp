// A unit with two returns that sends more than its car's file lets a scan have: that is told before
// and after.
#include "tools/vehicles/two_returns.hpp"

#include <gtest/gtest.h>
#include <memory>

#include "fakes/hesai_packet.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/receive/run_statistics.hpp"

namespace iog::tools {
namespace {

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

// By the makers' data sheets, points a second of both returns.
TEST(TwoReturns, SendWhatTheDataSheetsSay) {
  EXPECT_NEAR(points_with_two_returns(lidar::kFormat<lidar::VelodyneVlp16>) * 10, 578'700, 500);
  EXPECT_NEAR(points_with_two_returns(lidar::kFormat<lidar::VelodynePuckHires>) * 10, 578'700, 500);
  EXPECT_NEAR(points_with_two_returns(lidar::kFormat<lidar::VelodyneHdl32e>) * 10, 1'388'900, 500);
  EXPECT_NEAR(points_with_two_returns(lidar::kFormat<lidar::VelodyneVlp32c>) * 10, 1'157'400, 500);
  EXPECT_NEAR(points_with_two_returns(lidar::kFormat<lidar::VelodyneHdl64eS3>) * 10, 2'222'200,
              500);
  EXPECT_NEAR(points_with_two_returns(lidar::kFormat<lidar::HesaiPandar40p>) * 10, 1'440'000, 500);
  EXPECT_NEAR(points_with_two_returns(lidar::kFormat<lidar::HesaiPandar64>) * 10, 2'304'000, 500);
  EXPECT_NEAR(points_with_two_returns(lidar::kFormat<lidar::HesaiQt64>) * 10, 768'000, 500);
  EXPECT_NEAR(points_with_two_returns(lidar::kFormat<lidar::HesaiQt128>) * 10, 2'304'000, 500);
  EXPECT_NEAR(points_with_two_returns(lidar::kFormat<lidar::HesaiXt16>) * 10, 640'000, 500);
  EXPECT_NEAR(points_with_two_returns(lidar::kFormat<lidar::HesaiXt32>) * 10, 1'280'000, 500);
  EXPECT_NEAR(points_with_two_returns(lidar::kFormat<lidar::HesaiXt32m>) * 10, 1'280'000, 500);
  EXPECT_EQ(points_with_two_returns(lidar::kFormat<lidar::VelodyneHdl64eS2>), 0U);
  EXPECT_EQ(points_with_two_returns(lidar::kFormat<lidar::OusterLegacy>), 0U);
  EXPECT_FALSE(sends_two_returns(lidar::kFormat<lidar::OusterRng19>));
  EXPECT_TRUE(sends_two_returns(lidar::kFormat<lidar::OusterRng19Dual>));
  EXPECT_FALSE(sends_two_returns(lidar::kFormat<lidar::HesaiXt32>));
  EXPECT_EQ(points_with_two_returns(lidar::kFormat<lidar::IbeoLux>), 0U);
}

TEST(TwoReturns, OnlyThoseThatDoNotFitAreWarnedOf) {
  for (const CatalogueEntry& car : all_vehicles()) {
    const std::string_view name = car.vehicle->name;
    const bool is_too_dense =
        name == "roof_pandar64" || name == "roof_hdl64e" || name == "roof_qt128";
    EXPECT_EQ(!warning_of_two_returns(car).empty(), is_too_dense) << car.vehicle->name;
  }
  EXPECT_EQ(
      warning_of_two_returns(find_vehicle("roof_pandar64")),
      "warning: roof_pandar64: sensor roof: with two returns it sends 230381 points a turn at "
      "10 Hz, and its max_points_per_scan is 122880: 47 % of a turn would be dropped, over "
      "budget; set it to one return\n");
}

// A turn of 600 packets of 384 points, of which a frame takes 320.
TEST(TwoReturns, WhatIsOverBudgetIsToldWithItsLimit) {
  RunStatistics statistics;
  FrameAssembler assembler([&](GridFrame&& frame) { statistics.add(frame); });
  vehicle::Vehicle car = *find_vehicle("roof_pandar64").vehicle;
  car.frame_period_us = 150'000;
  const auto target = std::make_unique<OfflineTarget>(
      car, [&](std::span<const std::byte> message) { assembler.take(message); });
  for (int i = 0; i < 600; ++i) {
    const auto us = static_cast<std::uint64_t>(i) * 500 / 3;
    static_cast<void>(
        target->take({.time_us = us,
                      .source = {},
                      .destination = {.ipv4 = 0, .port = 2368},
                      .payload = tests::HesaiPacket{.first_azimuth = i * 60 % 36'000,
                                                    .mode = 0x39,
                                                    .is_dual = true,
                                                    .time_us = static_cast<std::uint32_t>(us)}
                                     .bytes()}));
  }
  target->finish();
  assembler.finish();
  const std::string table = statistics.table(false);
  EXPECT_TRUE(contains(table, "OVER BUDGET           280 of 600 packets dropped, 47 %: ")) << table;
  EXPECT_TRUE(contains(table, "sensor roof may have 122880 points a scan (max_points_per_scan)"))
      << table;
}

}  // namespace
}  // namespace iog::tools
