// Where a sensor is covered, and where it only looks at the open sky.
#include "intake/blocked_sectors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <random>
#include <vector>

#include "fakes/flat_scan.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/test_vehicles.hpp"
#include "fakes/vlp16_scene.hpp"
#include "intake/watched_sectors.hpp"
#include "tools/car/tables.hpp"

namespace iog::intake {
namespace {

using tests::covered;
using tests::field;
using tests::Scene;

constexpr std::uint32_t kReplayer = 0x0A000202;
constexpr std::uint64_t kAll = ~std::uint64_t{0};

vehicle::Sensor vlp16(const description::MountConfig& mount) {
  return description::sensor_of(tests::test_vlp16(100, mount), tests::LevelVlp16::kDescription);
}

vehicle::Sensor flat_scanner(double pitch_deg = 0) {
  return description::sensor_of(tests::FlatScanner::config(pitch_deg),
                                tests::FlatScanner::kDescription);
}

class Unit {
 public:
  explicit Unit(const vehicle::Sensor& sensor)
      : sensor_(sensor), intake_(std::span(&sensor_, 1), kReplayer), watched_({&sensor_, 1}) {}

  // A turn of a VLP-16 in frames of so many packets; shuffled by a seed, if one is given.
  void turn(const Scene& scene, std::size_t packets_of_frame = 75, std::uint32_t seed = 0) {
    std::vector<std::vector<std::byte>> packets = turns_.turn(scene);
    for (std::size_t begin = 0; begin < packets.size(); begin += packets_of_frame) {
      const std::size_t end = std::min(packets.size(), begin + packets_of_frame);
      if (seed != 0) {
        std::mt19937 random(seed);
        std::shuffle(packets.begin() + static_cast<std::ptrdiff_t>(begin),
                     packets.begin() + static_cast<std::ptrdiff_t>(end), random);
      }
      for (std::size_t i = begin; i < end; ++i) {
        take(packets[i]);
      }
      end_frame();
    }
  }
  // A scan of a LUX, of points that are so far away, cm; none if that is empty.
  void scan(const std::function<int(int angle_ticks)>& range_cm, int flags = 0) {
    tests::LuxMessage message{.scan_number = ++scans_};
    for (int angle = 1590; angle > -1600; angle -= 20) {
      if (range_cm(angle) >= 0) {
        message.points.push_back(
            {.flags = flags, .angle_ticks = angle, .range_cm = range_cm(angle)});
      }
    }
    take(message.bytes());
    end_frame();
  }

  void flat_scan(const std::function<int(int azimuth_deg)>& range_mm) {
    for (const std::vector<std::byte>& bytes : flat_scans_.scan(range_mm)) {
      take(bytes);
    }
    end_frame();
  }

  [[nodiscard]] const Surroundings& now() const { return now_; }
  [[nodiscard]] Blocked state() const { return now_.sensors[0]; }
  [[nodiscard]] const vehicle::Sensor& sensor() const { return sensor_; }

 private:
  void take(const std::vector<std::byte>& bytes) {
    const auto packet = intake_.receive({kReplayer, 100, bytes});
    ASSERT_TRUE(packet.has_value());
    ASSERT_EQ(intake_.classify(*packet), Intake::Outcome::kThisFrame);
    intake_.accept(*packet);
    watched_.add(0, packet->packet);
  }
  void end_frame() {
    now_us_ += 100'000;
    now_ = watched_.at_end(intake_, now_us_);
    watched_.end_frame(intake_, now_us_);
    intake_.start_frame();
  }

  vehicle::Sensor sensor_;
  Intake intake_;
  WatchedSectors watched_;
  Surroundings now_;
  tests::SceneTurns turns_;
  int scans_ = 0;
  tests::FlatScans flat_scans_;
  std::uint64_t now_us_ = 0;
};

TEST(BlockedSectors, AnOpenFieldIsWatched) {
  Unit unit(vlp16({.z_m = 1.5}));
  for (int i = 0; i < 50; ++i) {
    unit.turn(field);
    ASSERT_EQ(unit.now().unwatched, 0U);
    ASSERT_EQ(unit.now().blocked, 0U);
  }
}

// Ice melts: three turns on, the unit watches again.
TEST(BlockedSectors, ACoverIsFoundInATurnAndIsGoneAfterThree) {
  Unit unit(vlp16({.z_m = 1.5}));  // with a cap from the start
  for (int i = 0; i < 20; ++i) {
    unit.turn(covered);
    ASSERT_EQ(unit.now().unwatched, kAll) << i;
    ASSERT_EQ(unit.state(), Blocked::kWhole) << i;
  }
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(unit.now().unwatched, kAll) << i;
    unit.turn(field);
  }
  EXPECT_EQ(unit.now().unwatched, 0U);
  EXPECT_EQ(unit.state(), Blocked::kNot);
}

// From 90 to 180 degrees to the right are sectors 32 to 47.
TEST(BlockedSectors, ACoveredQuarterIsThat) {
  constexpr std::uint64_t kQuarter = 0x0000'FFFF'0000'0000;
  Unit unit(vlp16({.z_m = 1.5}));
  for (int i = 0; i < 10; ++i) {
    unit.turn([](double azimuth, int elevation) {
      return azimuth >= 90 && azimuth < 180 ? 0 : field(azimuth, elevation);
    });
    ASSERT_EQ(unit.now().blocked, kQuarter);
    ASSERT_EQ(unit.now().unwatched, kQuarter);
    ASSERT_EQ(unit.state(), Blocked::kPartly);
  }
}

// Mud that stray light gets through, that is nearer than the unit measures, or below its middle.
TEST(BlockedSectors, WhatComesBackFromACoverIsNothing) {
  int beams = 0;
  const Scene shining = [&](double azimuth, int elevation) {
    return ++beams % 61 == 0 ? field(azimuth, elevation) : 0;
  };
  const Scene near = [](double /*azimuth*/, int /*elevation*/) { return 0.2; };
  for (const Scene& scene : {shining, near}) {
    Unit unit(vlp16({.z_m = 1.5}));
    for (int i = 0; i < 3; ++i) {  // few beams are looked at: a sector may need another turn
      unit.turn(scene);
    }
    EXPECT_EQ(unit.now().blocked, kAll);
    EXPECT_EQ(unit.now().unwatched, kAll);
  }
}

// Between walls, mud on the lower half of the window: what the ground gave before is missing. Where
// the ground never gives anything, that is all that is known of it.
TEST(BlockedSectors, LowBeamsAreMissedWhereTheyCameBackBefore) {
  const auto walls = [](double azimuth, int elevation) {
    return elevation < 0 ? field(azimuth, elevation) : 20.0;
  };
  const auto low = [](double /*azimuth*/, int elevation) { return elevation < 0 ? 0.0 : 20.0; };
  Unit unit(vlp16({.z_m = 1.5}));
  for (int i = 0; i < 30; ++i) {
    unit.turn(low);
    ASSERT_EQ(unit.now().blocked, 0U) << i;
  }
  for (int i = 0; i < 30; ++i) {
    unit.turn(walls);
    ASSERT_EQ(unit.now().blocked, 0U) << i;
  }
  for (int i = 0; i < 100; ++i) {
    unit.turn(low);
    ASSERT_EQ(unit.now().blocked, kAll) << i;
  }
}

// 25 degrees up in front: what comes back is behind it. Its sky is blocked with the rest alone.
TEST(BlockedSectors, AnOpenSkyIsExpectedWhereAllBeamsRise) {
  const auto tilted = [](double azimuth, int elevation) {
    const double front_deg = 25 * std::cos(azimuth * std::numbers::pi / 180);
    return field(azimuth, static_cast<int>(std::lround(elevation + front_deg)));
  };
  Unit unit(vlp16({.z_m = 1.5, .pitch_deg = -25}));
  for (int i = 0; i < 40; ++i) {
    unit.turn(tilted);
    ASSERT_EQ(unit.now().blocked, 0U) << i;
    ASSERT_EQ(unit.now().unwatched, 0U) << i;
  }
  unit.turn(covered);
  EXPECT_EQ(unit.now().unwatched, kAll);
  EXPECT_EQ(unit.state(), Blocked::kWhole);
}

// Also in frames that are shorter than a turn.
TEST(BlockedSectors, NoOrderOfPacketsShows) {
  for (const std::size_t packets : {75U, 30U}) {
    for (const std::uint32_t seed : {1U, 2U, 3U, 4U, 5U}) {
      Unit in_order(vlp16({.z_m = 1.5}));
      Unit shuffled(vlp16({.z_m = 1.5}));
      for (int i = 0; i < 12; ++i) {
        const Scene half = [=](double azimuth, int elevation) {
          return i % 6 > 1 && azimuth < 200 ? 0 : field(azimuth, elevation);
        };
        in_order.turn(half, packets);
        shuffled.turn(half, packets, seed);
        ASSERT_EQ(in_order.now().blocked, shuffled.now().blocked) << i;
        ASSERT_EQ(in_order.now().unwatched, shuffled.now().unwatched) << i;
        if (i % 6 > 2 || i == 1) {
          ASSERT_EQ(in_order.state(), i == 1 ? Blocked::kNot : Blocked::kPartly) << "two turns on";
        }
      }
    }
  }
}

// A LUX sends no point, or such of distance 0, or its own dirt.
TEST(BlockedSectors, ACoveredLuxIsFoundInThreeScans) {
  std::minstd_rand random;
  const auto wall = [&](int /*angle*/) { return 1000 + static_cast<int>(random() % 8); };
  for (const int kind : {0, 1, 2}) {
    Unit unit(tests::OneLux::kVehicle.sensors[0]);
    unit.scan(wall);
    EXPECT_NE(unit.now().unwatched, kAll);
    for (int i = 0; i < 3; ++i) {
      ASSERT_EQ(unit.state(), Blocked::kNot);
      unit.scan([&](int angle) { return kind == 0   ? -1
                                        : kind == 1 ? 0
                                                    : wall(angle); },
                kind == 2 ? 0x08 : 0);
      ASSERT_EQ(unit.now().unwatched, kAll) << kind;
    }
    EXPECT_EQ(unit.state(), Blocked::kWhole) << kind;
    unit.scan(wall);
    EXPECT_EQ(unit.now().unwatched, kAll);
    unit.scan(wall);
    EXPECT_EQ(unit.state(), Blocked::kNot);
    EXPECT_EQ(std::popcount(~unit.now().unwatched), 18);
  }
}

// Its left half: sectors 0 to 8. What comes back from time to time is enough.
TEST(BlockedSectors, AHalfOfALuxFromWhichNothingComesBackIsFoundInThirtyTwoScans) {
  std::minstd_rand random;
  Unit unit(tests::OneLux::kVehicle.sensors[0]);
  for (int i = 0; i < 100; ++i) {
    unit.scan([&](int angle) {
      return angle > 0 && i % 16 != 0 ? -1 : 1000 + static_cast<int>(random() % 8);
    });
    ASSERT_EQ(unit.state(), Blocked::kNot) << i;
  }
  for (int i = 0; i < 32; ++i) {
    unit.scan([&](int angle) { return angle > 0 ? -1 : 1000 + static_cast<int>(random() % 8); });
  }
  EXPECT_EQ(unit.state(), Blocked::kPartly);
  EXPECT_EQ(unit.now().blocked, 0x1FFU);
}

// No ground is in the range of a level 2D scanner, so infinity ahead is an open corridor.
TEST(BlockedSectors, NothingAheadOfALevelScannerIsNoCover) {
  const auto corridor = [](int azimuth) { return std::abs(azimuth) < 40 ? 0 : 2'000; };
  const auto open = [](int /*azimuth*/) { return 0; };
  Unit unit(flat_scanner());
  for (int i = 0; i < 100; ++i) {
    unit.flat_scan(i < 50 ? +corridor : +open);
    ASSERT_EQ(unit.now().blocked, 0U) << i;
    ASSERT_EQ(unit.state(), Blocked::kNot) << i;
  }
}

// The same scanner, pitched down: its front beams meet the ground at 8 m.
TEST(BlockedSectors, NothingAheadOfAScannerThatMeetsTheGroundIsACover) {
  const auto no_ground = [](int azimuth) { return std::abs(azimuth) < 40 ? 0 : 2'000; };
  Unit unit(flat_scanner(3));
  for (int i = 0; i < 32; ++i) {
    ASSERT_EQ(unit.now().blocked, 0U) << i;
    unit.flat_scan(no_ground);
  }
  EXPECT_NE(unit.now().blocked & 1, 0U);
}

// Returns nearer than it measures are of a cover, also where no ground can be.
TEST(BlockedSectors, ANearCoverOfALevelScannerIsFoundAndIsGoneInTheOpen) {
  const auto near = [](int azimuth) { return azimuth < 0 ? 50 : 2'000; };
  const auto open = [](int azimuth) { return azimuth < 0 ? 0 : 2'000; };
  Unit unit(flat_scanner());
  for (int i = 0; i < 32; ++i) {
    ASSERT_EQ(unit.now().blocked, 0U) << i;
    unit.flat_scan(near);
  }
  EXPECT_EQ(unit.state(), Blocked::kPartly);
  EXPECT_EQ(unit.now().blocked & 0xFFFF, 0U);
  for (int i = 0; i < 2; ++i) {
    ASSERT_NE(unit.now().blocked, 0U);
    unit.flat_scan(open);
  }
  EXPECT_EQ(unit.now().blocked, 0U);
}

}  // namespace
}  // namespace iog::intake
