// What becomes of a log: the poses that a target is sent, and what is told of the others.
#include <algorithm>
#include <cmath>
#include <functional>

#include "gtest/gtest.h"

#include "tools/poses/local_plane.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/simulate/random.hpp"

namespace iog::tools {
namespace {

LoggedPose logged(std::uint64_t time_us, double x_m, double y_m, double heading_rad) {
  return {.time_us = time_us, .x_m = x_m, .y_m = y_m, .heading_rad = heading_rad};
}

TEST(ConvertedLog, TheMountIsTakenOff) {
  PoseLog log;
  log.poses = {logged(0, 10, 20, 0), logged(1'000'000, 10, 20, 90 * kRadians)};
  const ConvertedLog result = converted(log, {.mount_x_m = 1, .mount_y_m = 0.5});
  EXPECT_NEAR(result.samples[0].x_m, 9, 1e-12);
  EXPECT_NEAR(result.samples[0].y_m, 19.5, 1e-12);
  EXPECT_NEAR(result.samples[1].x_m, 10.5, 1e-12);
  EXPECT_NEAR(result.samples[1].y_m, 19, 1e-12);
}

TEST(ConvertedLog, MotionIsThatBetweenTheNeighbours) {
  PoseLog log;
  // Backwards along a heading that passes half a turn.
  log.poses = {logged(0, 0, 0, 179 * kRadians), logged(100'000, 1, 0, -180 * kRadians),
               logged(200'000, 2, 0, -179 * kRadians)};
  log.poses[2].speed_mps = 7;
  const ConvertedLog result = converted(log, {.sigma_m = 0.04, .sigma_heading_rad = 0.003});
  ASSERT_EQ(result.samples.size(), 3U);
  EXPECT_NEAR(result.samples[1].speed_mps, -10, 1e-9);
  EXPECT_NEAR(result.samples[1].yaw_rate_rps, 10 * kRadians, 1e-9);
  EXPECT_EQ(result.samples[2].speed_mps, 7);
  EXPECT_EQ(result.samples[1].sigma_m, 0.04);
  EXPECT_EQ(result.samples[1].sigma_heading_rad, 0.003);
  EXPECT_EQ(result.taken_sigmas + result.taken_sigma_headings, 0U);
  const ConvertedLog assumed = converted(log, {});
  EXPECT_EQ(assumed.samples[1].sigma_m, 0.05);
  EXPECT_EQ(assumed.samples[1].sigma_heading_rad, 0.002);
  EXPECT_EQ(assumed.taken_sigmas, 3U);
  EXPECT_EQ(assumed.taken_sigma_headings, 3U);
}

// Drivers leave columns at zero. A car that stands may do so in some rows.
TEST(ConvertedLog, MotionThatIsZeroThroughoutIsNotStated) {
  PoseLog log;
  log.poses = {logged(0, 0, 0, 0), logged(100'000, 1, 0, 0.02), logged(200'000, 2, 0, 0.04)};
  for (LoggedPose& pose : log.poses) {
    pose.speed_mps = 0;
    pose.yaw_rate_rps = 0;
  }
  const ConvertedLog result = converted(log, {});
  EXPECT_NEAR(result.samples[1].speed_mps, 10, 0.01);
  EXPECT_NEAR(result.samples[1].yaw_rate_rps, 0.2, 1e-9);
  log.poses[2].speed_mps = 3;
  EXPECT_EQ(converted(log, {}).samples[1].speed_mps, 0);
}

// The limits of a target are 150 mm and 3 mrad. A wheel odometry of the usual tutorial states 32 mm
// and 100 mrad.
TEST(ConvertedLog, PosesThatAreTooImpreciseAreTold) {
  PoseLog log;
  log.poses = {logged(0, 0, 0, 0), logged(100'000, 1, 0, 0), logged(200'000, 2, 0, 0)};
  for (LoggedPose& pose : log.poses) {
    pose.sigma_m = 0.15;
    pose.sigma_heading_rad = 0.003;
  }
  EXPECT_TRUE(converted(log, {}).notes.empty());
  log.poses[1].sigma_m = 0.032;
  log.poses[1].sigma_heading_rad = 0.1;
  EXPECT_EQ(
      converted(log, {}).notes,
      std::vector<std::string>{
          "1 pose is too imprecise: the motion of a second has standard deviations of up to "
          "150 mm and 100 mrad, and a target uses none above 150 mm or 3 mrad; if the poses "
          "are better, --poses-sigma MM MRAD (`iog pose`: --sigma, --heading-sigma) says so"});
  const ConvertedLog told = converted(log, {.sigma_m = 0.02, .sigma_heading_rad = 0.001});
  EXPECT_TRUE(told.notes.empty());
  EXPECT_EQ(told.samples[1].sigma_m, 0.02);
  EXPECT_EQ(told.samples[1].sigma_heading_rad, 0.001);
  EXPECT_TRUE(words_of(told).empty());
}

// A drive of 1 m/s^2 that turns by 0.1 rad/s, logged 5 and 4 times a second, and with a gap of 0.3
// s. From 10 Hz on, poses stay as they are.
TEST(ConvertedLog, PosesBelowTenHertzAreInterpolated) {
  const auto log_of = [](std::uint64_t period_us) {
    PoseLog log;
    for (std::uint64_t time_us = 0; time_us <= 2'000'000; time_us += period_us) {
      const double time_s = static_cast<double>(time_us) / 1e6;
      log.poses.push_back(logged(time_us, time_s * time_s / 2, 0, 0.1 * time_s));
    }
    return log;
  };
  for (const std::uint64_t period_us : {200'000U, 250'000U}) {
    const ConvertedLog result = converted(log_of(period_us), {.sigma_m = 0.01});
    EXPECT_TRUE(result.notes.empty());
    EXPECT_EQ(result.poses, 2'000'000 / period_us + 1);
    for (std::size_t i = 1; i < result.samples.size(); ++i) {
      EXPECT_LE(result.samples[i].time_us - result.samples[i - 1].time_us, 21'000U);
    }
    for (const PoseSample& sample : result.samples) {
      const double time_s = static_cast<double>(sample.time_us) / 1e6;
      EXPECT_NEAR(sample.x_m, time_s * time_s / 2, 0.008);
      EXPECT_NEAR(sample.heading_rad, 0.1 * time_s, 1e-9);
      EXPECT_NEAR(sample.speed_mps, time_s, 0.2);
      EXPECT_EQ(sample.sigma_m, 0.01);
    }
  }
  EXPECT_EQ(converted(log_of(100'000), {}).samples.size(), 21U);
  EXPECT_EQ(converted(log_of(300'000), {}).samples.size(), 7U);
}

// A car stands for a second and leaves by 2 m/s^2, measured 5 times a second and logged 50 times.
TEST(ConvertedLog, HeldValuesAreLeftOut) {
  const auto place_at = [](double time_s) { return std::pow(std::max(time_s - 1, 0.0), 2); };
  PoseLog log;
  for (std::size_t i = 0; i <= 240; ++i) {
    const auto measured = static_cast<double>(i / 10) * 0.2;
    log.poses.push_back(logged(1'000'000 + 20'000 * i, place_at(measured), 0, 0));
    log.poses.back().place = i + 2;
  }
  const ConvertedLog result = converted(log, {});
  EXPECT_EQ(result.poses, 241U - 162);
  EXPECT_EQ(result.remarks,
            std::vector<std::string>{"162 poses that repeat the one before until the next "
                                     "measurement (first: line 63)"});
  for (const PoseSample& sample : result.samples) {
    EXPECT_NEAR(sample.x_m, place_at(static_cast<double>(sample.time_us) / 1e6 - 1), 0.05);
  }
}

TEST(ConvertedLog, WhatTheTargetWouldDropIsLeftOutAndCounted) {
  PoseLog log;
  log.poses = {logged(100'000, 0, 0, 0), logged(100'000, 0, 0, 0), logged(90'000, 0, 0, 0),
               logged(107'999, 0, 0, 0), logged(108'000, 0, 0, 0), logged(200'000, 0, 0, 0)};
  log.poses.back().heading_rad.reset();
  const ConvertedLog result = converted(log, {});
  EXPECT_EQ(result.samples.size(), 2U);
  EXPECT_EQ(result.remarks,
            (std::vector<std::string>{"1 pose without a heading",
                                      "2 poses that are not newer than the one before",
                                      "1 pose less than 8 ms after the one before"}));
}

TEST(ConvertedLog, APoseThatIsNotFiniteIsLeftOutAndCounted) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  PoseLog log;
  log.poses = {logged(100'000, kNaN, 0, 0), logged(200'000, 0, kNaN, 0),
               logged(300'000, 0, 0, kNaN), logged(400'000, 0, 0, 0), logged(500'000, 0, 0, 0)};
  const ConvertedLog result = converted(log, {});
  EXPECT_EQ(result.samples.size(), 2U);
  EXPECT_EQ(result.remarks,
            std::vector<std::string>{"3 poses whose position or heading is not finite"});
}

// UTM zone 32 in Karlsruhe; a northing is beyond 1000 km.
TEST(ConvertedLog, PositionsOfACountrysGridAreCountedFromTheFirst) {
  PoseLog log;
  log.poses = {logged(100'000, 456'789, 5'428'765, 0), logged(200'000, 456'790.5, 5'428'766, 0)};
  const ConvertedLog result = converted(log, {});
  ASSERT_EQ(result.samples.size(), 2U);
  EXPECT_NEAR(result.samples[1].x_m - result.samples[0].x_m, 1.5, 1e-6);
  EXPECT_NEAR(result.samples[1].y_m - result.samples[0].y_m, 1, 1e-6);
  EXPECT_LT(std::abs(result.samples[0].y_m), 10);
  EXPECT_EQ(result.notes,
            std::vector<std::string>{"positions are counted from x 456791 m, y 5428766 m, as a "
                                     "target takes none beyond 1000 km"});
}

// A car at 10 m/s whose pose is written 10 times a second from line 2 on.
PoseLog even_log() {
  PoseLog log;
  for (std::size_t i = 0; i < 100; ++i) {
    log.poses.push_back(logged(1'000'000'000 + 100'000 * i, static_cast<double>(i), 0, 0));
    log.poses.back().place = i + 2;
  }
  return log;
}

TEST(ConvertedLog, AnOutlierIsLeftOutWithItsLine) {
  using Poses = std::vector<LoggedPose>;
  struct Case {
    std::function<void(Poses&)> spoil;
    std::size_t first_line;
    std::size_t lines;
  };
  const auto off = [](std::size_t row, double metres, std::size_t rows = 1) {
    return [=](Poses& poses) {
      for (std::size_t i = row; i < row + rows; ++i) {
        poses[i].x_m += metres;
      }
    };
  };
  const std::vector<Case> cases{
      {off(50, 25), 52, 1},
      {off(50, -1.5), 52, 1},
      {off(50, 5, 2), 52, 2},
      {off(20, 300, 7), 22, 7},
      {off(0, 25), 2, 1},
      {off(0, 400, 2), 2, 2},
      {off(99, 25), 101, 1},
      {off(98, 25, 2), 100, 2},
      {off(50, 6e6), 52, 1},
      {[](Poses& poses) { poses[50].heading_rad = 180 * kRadians; }, 52, 1},
      {[](Poses& poses) { poses[50].speed_mps = 500; }, 52, 1},
      {[](Poses& poses) { poses[50].time_us += 3'600'000'000; }, 52, 1},
      {[](Poses& poses) { poses[50].time_us = 7; }, 52, 1}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    PoseLog log = even_log();
    cases[i].spoil(log.poses);
    const ConvertedLog result = converted(log, {});
    EXPECT_EQ(result.poses, 100 - cases[i].lines) << i;
    for (const PoseSample& sample : result.samples) {
      EXPECT_NEAR(sample.x_m, static_cast<double>(sample.time_us) / 1e5 - 10'000, 1e-6) << i;
      EXPECT_NEAR(sample.speed_mps, 10, 1e-6) << i;
    }
    ASSERT_EQ(result.remarks.size(), 1U) << i;
    EXPECT_TRUE(result.remarks[0].starts_with(std::to_string(cases[i].lines) + " pose")) << i;
    EXPECT_NE(result.remarks[0].find("line " + std::to_string(cases[i].first_line) + ')'),
              std::string::npos)
        << result.remarks[0];
  }
}

// A noisy receiver, hard braking, a clock that steps back, a silence: no outliers.
TEST(ConvertedLog, WhatIsNoOutlierStays) {
  PoseLog noisy = even_log();
  Random random(3);
  for (LoggedPose& pose : noisy.poses) {
    pose.x_m += random.between(-1, 1);
  }
  EXPECT_GE(converted(noisy, {}).samples.size(), 97U);
  PoseLog braking = even_log();
  for (std::size_t i = 0; i < 10; ++i) {  // from 10 m/s to rest within a second
    const double time_s = 0.1 * static_cast<double>(i + 1);
    braking.poses[90 + i].x_m = 89 + 10 * time_s - 5 * time_s * time_s;
  }
  EXPECT_EQ(converted(braking, {}).samples.size(), 100U);
  PoseLog silent = even_log();
  for (std::size_t i = 50; i < 100; ++i) {
    silent.poses[i].time_us += 2'000'000;
    silent.poses[i].x_m -= 400;
  }
  EXPECT_EQ(converted(silent, {}).samples.size(), 100U);
  PoseLog stepped = even_log();
  for (std::size_t i = 50; i < 100; ++i) {
    stepped.poses[i].time_us -= 3'000'000;
  }
  EXPECT_GE(converted(stepped, {}).samples.size(), 50U);
  EXPECT_NE(converted(stepped, {}).remarks.at(0).find("not newer"), std::string::npos);
}

// A log in the plane of its first position, and a map whose plane is 5 km away: by the transform of
// the messages every pose is where the map's own plane has it.
TEST(ConvertedLog, PosesSayWhereTheyAreOnAMap) {
  const MapOrigin origin = map_origin_in("", "49.03,8.46");
  const LocalPlane plane(49, 8.4);
  PoseLog log;
  log.plane = plane;
  std::vector<LocalPlane::Place> on_map;
  for (int i = 0; i < 10; ++i) {
    const double latitude = 49 + 3e-4 * i;
    const double longitude = 8.4 - 4e-4 * i;
    const LocalPlane::Place at = plane.place_of(latitude, longitude);
    log.poses.push_back(
        logged(std::uint64_t{1'000'000} * static_cast<unsigned>(i), at.east_m, at.north_m, 0));
    on_map.push_back(origin.plane().place_of(latitude, longitude));
  }
  EXPECT_FALSE(converted(log, {}).samples.front().map);
  const pose::Sigma sigma{.position_mm = 80, .heading_10urad = 120};
  const ConvertedLog result = converted(log, {.map = PoseConversion::Map{origin, sigma}});
  for (std::size_t i = 0; i < on_map.size(); ++i) {
    ASSERT_TRUE(result.samples[i].map);
    const pose::MapTransform map = *result.samples[i].map;
    EXPECT_EQ(map.origin, origin.name());
    EXPECT_EQ(map.sigma, sigma);
    const double turn = map.local_frame.heading / 0x1p32 * 360 * kRadians;
    const double x = result.samples[i].x_m;
    const double y = result.samples[i].y_m;
    EXPECT_NEAR(map.local_frame.x_mm / 1e3 + x * std::cos(turn) - y * std::sin(turn),
                on_map[i].east_m, 0.01);
    EXPECT_NEAR(map.local_frame.y_mm / 1e3 + x * std::sin(turn) + y * std::cos(turn),
                on_map[i].north_m, 0.01);
  }
}

// An origin with its longitude first, and a town 530 km away, which a message can still say.
TEST(ConvertedLog, AMapOfAnotherPartOfTheEarthIsTold) {
  PoseLog log;
  log.plane = LocalPlane(48.4099, 15.6036);
  log.poses = {logged(0, 0, 0, 0), logged(100'000, 0, 0, 0)};
  const MapOrigin swapped = map_origin_in("", "15.6036,48.4099");
  const std::string told = words_of_far_map(log, swapped);
  EXPECT_TRUE(told.starts_with(
      "the log begins at 48.4099,15.6036, and the map's origin is 15.6036,48.4099 (latitude, "
      "longitude), "))
      << told;
  EXPECT_TRUE(told.ends_with(" km away; at most 1000 km is allowed: check their order")) << told;
  EXPECT_THROW(static_cast<void>(converted(log, {.map = PoseConversion::Map{swapped, {}}})),
               UsageError);
  const MapOrigin antipode = map_origin_in("", "-48.4099,-164.3964");
  EXPECT_NE(words_of_far_map(log, antipode), "") << "straight below, where the plane has it near";
  EXPECT_EQ(words_of_far_map(log, map_origin_in("", "49,8.4")), "");
}

TEST(ConvertedLog, WithoutLatitudesThereIsNoPlaceOnAMap) {
  PoseLog log;
  log.poses = {logged(0, 10, 20, 0)};
  EXPECT_FALSE(converted(log, {.map = PoseConversion::Map{}}).samples.front().map);
}

}  // namespace
}  // namespace iog::tools
