// Where nothing but the driving says whether a heading comes before or behind the times of its
// burst.
#include "tools/poses/nmea_cycle.hpp"

#include <cmath>
#include <span>
#include <string>

#include "gtest/gtest.h"

#include "tools/poses/pose_log.hpp"

namespace iog::tools {
namespace {

// Serpentines with an antenna 1.2 m ahead of the rear axle, which moves to the outside by its turn.
// Both ends of the log are cut such that they say nothing.
struct Serpentines {
  double turn_dps;
  double begin_mps;
  bool is_before;
  double period_s = 1;
  double way = 1;  // -1: in reverse
};

Cycle cycle_in(const Serpentines& drive) {
  std::vector<TimedMotion> times;
  std::vector<Untimed> sentences;
  for (std::size_t i = 0; i < 40; ++i) {
    const double seconds = drive.period_s * static_cast<double>(i);
    const double rate_dps = drive.turn_dps * std::cos(0.7 * seconds);
    const double heading_deg = 50 + drive.turn_dps / 0.7 * std::sin(0.7 * seconds);
    const double speed_mps = drive.begin_mps + 2 * std::sin(0.4 * seconds);
    const double aside_deg =
        std::atan(1.2 * rate_dps * kRadians / (drive.way * speed_mps)) / kRadians;
    times.push_back({static_cast<std::uint64_t>(std::llround(seconds * 1e6)), speed_mps,
                     heading_deg + aside_deg + (drive.way < 0 ? 180 : 0)});
    const std::size_t before = drive.is_before ? i : i + 1;
    if (before > 0 && before < 40) {
      sentences.push_back({.times_before = before, .angle_deg = heading_deg});
    }
  }
  return cycle_of(times, sentences, true, false, false);
}

TEST(NmeaCycle, DrivenCurvesDecideTheOrder) {
  for (const bool is_before : {true, false}) {
    for (const double way : {1.0, -1.0}) {
      const Cycle cycle = cycle_in({20, 10, is_before, 1, way});
      EXPECT_FALSE(cycle.is_order_open);
      // One sentence is cut off at the end where it would have been the first or the last.
      EXPECT_EQ(cycle.own[20], is_before ? 19U : 20U);
      EXPECT_EQ(cycle.open_s[20], 0);
    }
  }
}

TEST(NmeaCycle, StraightRoadsAndQuickPeriodsDoNot) {
  EXPECT_TRUE(cycle_in({0, 10, true}).is_order_open);
  EXPECT_EQ(cycle_in({0, 10, true}).open_s[20], 1);
  // The antenna may well be as far ahead as the way of 0.1 s.
  EXPECT_TRUE(cycle_in({20, 10, true, 0.1}).is_order_open);
}

TEST(NmeaCycle, NothingIsNeeded) {
  EXPECT_TRUE(cycle_of({}, {}, true, false, false).own.empty());
  EXPECT_TRUE(cycle_of({}, {{.angle_deg = 1}}, true, false, false).own.empty());
  EXPECT_FALSE(cycle_of({{}, {}}, {}, true, false, false).own[1]);
}

// Sentences of GGA and VTG alone: 10 m/s to the east, then the same in reverse.
TEST(NmeaCycle, ACourseMayBeOfVtg) {
  const std::string text =
      "$GPGGA,120000.0,4800.0000,N,0800.000000,E,4,12,0.8,100.0,M,45.0,M,,*65\r\n"
      "$GPVTG,90.0,T,,M,19.44,N,36.0,K,A*09\r\n"
      "$GPGGA,120000.2,4800.0000,N,0800.001600,E,4,12,0.8,100.0,M,45.0,M,,*60\r\n"
      "$GPVTG,270.0,T,,M,19.44,N,36.0,K,A*35\r\n";
  const PoseLog log = read_nmea_log(std::as_bytes(std::span(text)));
  ASSERT_EQ(log.poses.size(), 2U);
  EXPECT_NEAR(log.poses[0].heading_rad.value_or(9), 0, 1e-9);
  EXPECT_NEAR(log.poses[0].speed_mps.value_or(0), 10, 0.01);
  EXPECT_NEAR(log.poses[1].speed_mps.value_or(0), -10, 0.01);
}

// A receiver of several positions a second whose times are whole seconds: 2 m, 4 m and 22 m from
// the first one. The last sentence repeats the one of its time that is used.
TEST(NmeaLog, PositionsOfTheSameTimeAreCounted) {
  const std::string text =
      "$GPGGA,120000,4800.0000,N,00800.000000,E,4,12,0.8,100.0,M,45.0,M,,*4B\r\n"
      "$GPRMC,120000,A,4800.0000,N,00800.000000,E,19.44,90.0,010524,,,A*44\r\n"
      "$GPGGA,120000,4800.0000,N,00800.001600,E,4,12,0.8,100.0,M,45.0,M,,*4C\r\n"
      "$GPRMC,120000,A,4800.0000,N,00800.001600,E,19.44,90.0,010524,,,A*43\r\n"
      "$GPGGA,120000,4800.0000,N,00800.003200,E,4,12,0.8,100.0,M,45.0,M,,*4A\r\n"
      "$GPRMC,120000,A,4800.0000,N,00800.003200,E,19.44,90.0,010524,,,A*45\r\n"
      "$GPGGA,120001,4800.0000,N,00800.016000,E,4,12,0.8,100.0,M,45.0,M,,*4D\r\n"
      "$GPRMC,120001,A,4800.0000,N,00800.016000,E,19.44,90.0,010524,,,A*42\r\n"
      "$GPGGA,120001,4800.0000,N,00800.017600,E,4,12,0.8,100.0,M,45.0,M,,*4A\r\n"
      "$GPRMC,120001,A,4800.0000,N,00800.017600,E,19.44,90.0,010524,,,A*45\r\n"
      "$GPRMC,120001,A,4800.0000,N,00800.01600,E,19.44,90.0,010524,,,A*72\r\n";
  const PoseLog log = read_nmea_log(std::as_bytes(std::span(text)));
  EXPECT_EQ(log.remarks, std::vector<std::string>{
                             "3 positions with the time of an earlier one (first: line 3)"});
  ASSERT_EQ(log.poses.size(), 2U);
  EXPECT_NEAR(log.poses[1].x_m, 19.90, 0.01) << "0.016 minutes at 48 degrees";
}

}  // namespace
}  // namespace iog::tools
