// When packets were measured: against real numbers for a LUX, by trying hours for a VLP-16.
#include "intake/measurement_time.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "lidar/ibeo_lux.hpp"

namespace iog::intake {
namespace {

constexpr std::uint64_t kNoonUs = 1'714'564'800'000'000;  // 2024-05-01 12:00 UTC

const vehicle::Sensor& lux() { return tests::OneLux::kVehicle.sensors[0]; }

// A message of a scan: the angles where its sector starts and ends, in ticks, + is left.
lidar::PacketInfo lux_packet(int start, int end, std::uint64_t begin_us, std::uint64_t end_us) {
  constexpr int kTurn = lidar::IbeoLux::kTicksPerTurn;
  const int right = std::min(start, end);
  lidar::PacketInfo info;
  info.sector = {.first_ticks = static_cast<std::uint16_t>((right + kTurn) % kTurn),
                 .width_ticks = static_cast<std::uint16_t>(std::abs(start - end))};
  info.sweep = {.begin_us = begin_us, .end_us = end_us, .turns_right = start >= end};
  return info;
}

// A scan of 100 degrees, 3200 ticks, from one side to the other in 11,111 us.
TEST(MeasurementTime, AWholeScanOfALuxIsMeasuredInItsMiddle) {
  EXPECT_EQ(measured_us(lux(), lux_packet(1600, -1600, kNoonUs, kNoonUs + 11'112), 0),
            kNoonUs + 5'556);
  EXPECT_EQ(measured_us(lux(), lux_packet(-1600, 1600, kNoonUs, kNoonUs + 11'112), 0),
            kNoonUs + 5'556);
}

TEST(MeasurementTime, AMessageOfALuxIsMeasuredInTheMiddleOfItsSector) {
  tests::Random random(811);
  for (int i = 0; i < tests::effort(20'000, 500); ++i) {
    const int start = random.between(-1600, 1600);
    const int end = random.between(-1600, 1600);
    const auto duration_us = static_cast<std::uint64_t>(random.between(0, 80'000));
    const double middle = (start + end) / 2.0;
    const double share = (start >= end ? 1600 - middle : middle + 1600) / 3200;
    const std::uint64_t measured =
        measured_us(lux(), lux_packet(start, end, kNoonUs, kNoonUs + duration_us), 0);
    ASSERT_NEAR(static_cast<double>(measured - kNoonUs), share * static_cast<double>(duration_us),
                0.5 + 1e-6);
  }
}

// Whatever a message says, its time is within a second of its scan's begin.
TEST(MeasurementTime, AStrangeScanLastsASecondAtMost) {
  EXPECT_EQ(measured_us(lux(), lux_packet(1600, -1600, kNoonUs, 0), 0), kNoonUs);
  EXPECT_EQ(measured_us(lux(), lux_packet(1600, -1600, kNoonUs, 2 * kNoonUs), 0),
            kNoonUs + 500'000);
  EXPECT_EQ(measured_us(lux(), lux_packet(5760, 5700, kNoonUs, kNoonUs + 11'111), 0), kNoonUs);
  EXPECT_EQ(measured_us(lux(), lux_packet(-5700, -5760, kNoonUs, kNoonUs + 11'111), 0),
            kNoonUs + 11'111);
}

// Of all hours the one in which the packet is nearest to what is known.
TEST(MeasurementTime, AVlp16IsMeasuredInTheNearestHour) {
  constexpr std::int64_t kHourUs = 3'600'000'000;
  tests::Random random(812);
  for (int i = 0; i < tests::effort(20'000, 500); ++i) {
    const auto near_us =
        static_cast<std::int64_t>(kNoonUs) + random.between(0, 2'000'000'000) * std::int64_t{7};
    lidar::PacketInfo info;
    info.sweep.begin_us = static_cast<std::uint64_t>(random.between(0, 1'799'999'000)) * 2;
    info.sweep.end_us = info.sweep.begin_us + 1'327;
    info.sweep.is_of_hour = true;
    info.sweep.is_of_packet = true;
    const auto middle_us = static_cast<std::int64_t>(info.sweep.begin_us) + 663;
    std::int64_t nearest_us = 0;
    for (std::int64_t hour = near_us / kHourUs - 2; hour <= near_us / kHourUs + 2; ++hour) {
      const std::int64_t at_us = hour * kHourUs + middle_us;
      if (std::abs(at_us - near_us) < std::abs(nearest_us - near_us)) {
        nearest_us = at_us;
      }
    }
    ASSERT_EQ(measured_us(lux(), info, static_cast<std::uint64_t>(near_us)),
              static_cast<std::uint64_t>(nearest_us));
  }
}

// An Ouster and a Hesai say the whole time; what is known does not matter.
TEST(MeasurementTime, APacketWithAWholeTimeIsMeasuredInItsMiddle) {
  lidar::PacketInfo info;
  info.sweep = {.begin_us = kNoonUs, .end_us = kNoonUs + 1'562, .is_of_packet = true};
  for (const std::uint64_t near_us : {std::uint64_t{0}, kNoonUs - 7'200'000'000, kNoonUs}) {
    EXPECT_EQ(measured_us(lux(), info, near_us), kNoonUs + 781);
  }
}

// Before anything is known, the first hour of all: no time is below zero.
TEST(MeasurementTime, TheFirstHourHasNoneBeforeIt) {
  lidar::PacketInfo info;
  info.sweep = {.begin_us = 3'500'000'000,
                .end_us = 3'500'001'328,
                .turns_right = true,
                .is_of_hour = true,
                .is_of_packet = true};
  EXPECT_EQ(measured_us(lux(), info, 0), 3'500'000'664U);
}

}  // namespace
}  // namespace iog::intake
