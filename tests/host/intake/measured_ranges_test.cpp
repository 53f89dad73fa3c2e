// A scanner that repeats what it has measured, under new stamps, is found out and not believed.
#include "intake/measured_ranges.hpp"

#include <gtest/gtest.h>
#include <span>
#include <vector>

#include "fakes/lux_message.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fakes/velodyne_packet.hpp"
#include "intake/intake.hpp"

namespace iog::intake {
namespace {

using tests::LuxMessage;
using tests::ThreeLux;
using Outcome = Intake::Outcome;

constexpr std::uint32_t kSender = 0x0A000202;

vehicle::Sensor vlp16() {
  vehicle::Sensor sensor = ThreeLux::kVehicle.sensors[0];
  sensor.format = lidar::kFormat<lidar::VelodyneVlp16>;
  sensor.layer_count = 16;
  sensor.azimuths = vehicle::AzimuthSteps(36'000, 360);
  sensor.max_points_per_scan = 76 * 384;
  return sensor;
}

// One unit and its packets, each with a stamp of its own, in frames as they come.
class Unit {
 public:
  explicit Unit(const vehicle::Sensor& sensor)
      : sensor_(sensor), intake_(std::span(&sensor_, 1), kSender) {}

  // Whether the packet is fused.
  bool is_taken(const std::vector<std::byte>& bytes) {
    const auto packet = intake_.receive({kSender, 100, bytes});
    EXPECT_TRUE(packet);
    Outcome outcome = packet ? intake_.classify(*packet) : Outcome::kDropped;
    if (outcome == Outcome::kNextFrame) {
      intake_.start_frame();
      outcome = intake_.classify(*packet);
    }
    if (outcome == Outcome::kThisFrame) {
      intake_.accept(*packet);
    }
    return outcome == Outcome::kThisFrame;
  }

  [[nodiscard]] std::uint32_t frozen() const {
    return intake_.packet_drops()[static_cast<std::size_t>(PacketDrop::kFrozen)];
  }
  [[nodiscard]] Intake& intake() { return intake_; }

 private:
  vehicle::Sensor sensor_;
  Intake intake_;
};

// A scene of a LUX, as its mirror sees it: so many points, and their noise.
LuxMessage lux_scan(int number, int points, std::uint32_t seed) {
  tests::Random random(seed);
  LuxMessage message{.scan_number = number, .points = {}};
  for (int i = 0; i < points; ++i) {
    message.points.push_back(
        {.layer = i % 4, .angle_ticks = i / 4, .range_cm = 1000 + random.between(0, 20)});
  }
  return message;
}

// The same with a turn of a VLP-16, of which each packet begins 19.2 degrees after the one before.
std::vector<std::byte> vlp16_packet(int number, std::uint32_t seed, int returns_of_16 = 16) {
  tests::Random random(seed);
  tests::VelodynePacket packet{.first_azimuth = number * 480 % 36'000,
                               .time_us = static_cast<std::uint32_t>(number) * 1'327U};
  for (auto& block : packet.ranges) {
    for (std::size_t i = 0; i < block.size(); ++i) {
      block[i] = static_cast<int>(i % 16) < returns_of_16 ? 5'000 + random.between(0, 20) : 0;
    }
  }
  return packet.bytes();
}

TEST(FrozenSensor, AScanThatComesAgainUnderANewNumberIsDropped) {
  Unit unit(ThreeLux::kVehicle.sensors[0]);
  EXPECT_TRUE(unit.is_taken(lux_scan(1, 40, 7).bytes()));
  for (int number = 2; number < 500; ++number) {
    EXPECT_FALSE(unit.is_taken(lux_scan(number, 40, 7).bytes())) << number;
    unit.intake().start_frame();
    EXPECT_EQ(unit.intake().report_of(0).state, SensorState::kSilent);
  }
  EXPECT_EQ(unit.frozen(), 498U);
  EXPECT_EQ(unit.intake().points_dropped(vehicle::Fate::kStale), 0U);  // the frame is over
  EXPECT_TRUE(unit.is_taken(lux_scan(500, 40, 8).bytes()));            // it measures again
  EXPECT_EQ(unit.intake().report_of(0).state, SensorState::kComplete);
}

TEST(FrozenSensor, OneRangeThatDiffersIsAMeasurement) {
  Unit unit(ThreeLux::kVehicle.sensors[0]);
  for (int number = 1; number < 100; ++number) {
    LuxMessage message = lux_scan(number, 40, 7);
    message.points[static_cast<std::size_t>(number) % 40].range_cm += 1 + number % 7;
    EXPECT_TRUE(unit.is_taken(message.bytes())) << number;
  }
  EXPECT_EQ(unit.frozen(), 0U);
}

// What has few returns may come twice: a field with nothing but two posts, a covered window.
TEST(FrozenSensor, AScanOfFewReturnsIsNotJudged) {
  Unit unit(ThreeLux::kVehicle.sensors[0]);
  for (int number = 1; number < 10; ++number) {
    EXPECT_TRUE(unit.is_taken(lux_scan(number, 31, 7).bytes())) << number;
  }
  Unit turning(vlp16());
  for (int number = 0; number < 300; ++number) {
    EXPECT_TRUE(turning.is_taken(vlp16_packet(number, 7, 7))) << number;
  }
  EXPECT_EQ(unit.frozen() + turning.frozen(), 0U);
}

// But of a unit that is known to be frozen it is not believed, from the next frame on, and until
// the frame after one that it measured.
TEST(FrozenSensor, AScanOfFewReturnsGoesWithItsUnit) {
  Unit unit(ThreeLux::kVehicle.sensors[0]);
  EXPECT_TRUE(unit.is_taken(lux_scan(1, 40, 7).bytes()));
  EXPECT_TRUE(unit.is_taken(lux_scan(2, 20, 7).bytes()));
  EXPECT_FALSE(unit.is_taken(lux_scan(3, 40, 7).bytes()));
  unit.intake().start_frame();
  EXPECT_FALSE(unit.is_taken(lux_scan(4, 20, 7).bytes()));
  unit.intake().start_frame();
  EXPECT_FALSE(unit.is_taken(lux_scan(5, 20, 9).bytes()));
  EXPECT_TRUE(unit.is_taken(lux_scan(6, 40, 8).bytes()));
  EXPECT_TRUE(unit.is_taken(lux_scan(7, 20, 9).bytes()));
  EXPECT_EQ(unit.frozen(), 3U);
}

// The last turn comes for ever; of the packets that share a place in the memory one may slip
// through.
TEST(FrozenSensor, ATurnThatComesAgainIsDropped) {
  Unit unit(vlp16());
  for (int number = 0; number < 75; ++number) {
    EXPECT_TRUE(unit.is_taken(vlp16_packet(number, 100U + static_cast<unsigned>(number))))
        << number;
  }
  int taken = 0;
  for (int number = 75; number < 75 * 40; ++number) {
    taken += unit.is_taken(vlp16_packet(number, 100U + static_cast<unsigned>(number % 75))) ? 1 : 0;
  }
  EXPECT_EQ(taken, 0);
  EXPECT_EQ(unit.frozen(), 75U * 39U);
}

TEST(FrozenSensor, WhatWasMeasuredLongAgoMayBeMeasuredAgain) {
  Unit unit(ThreeLux::kVehicle.sensors[0]);
  for (int turn = 0; turn < 3; ++turn) {
    for (int i = 0; i < 193; ++i) {
      const int number = turn * 193 + i;
      EXPECT_TRUE(unit.is_taken(lux_scan(number, 40, static_cast<std::uint32_t>(i)).bytes()))
          << number;
    }
  }
  EXPECT_EQ(unit.frozen(), 0U);
}

// docs/design.md: of two of a turn the first to come is taken, whichever it is, and that is
// counted.
TEST(FrozenSensor, OfTwoWithEqualRangesTheLaterOneIsDropped) {
  for (const int first : {3, 4}) {
    Unit unit(vlp16());
    EXPECT_TRUE(unit.is_taken(vlp16_packet(first, 100)));
    EXPECT_FALSE(unit.is_taken(vlp16_packet(7 - first, 100)));
    EXPECT_EQ(unit.frozen(), 1U);
  }
}

// A duplicate and a late packet have their own causes.
TEST(FrozenSensor, ADuplicateIsNotFrozen) {
  Unit unit(ThreeLux::kVehicle.sensors[0]);
  EXPECT_TRUE(unit.is_taken(lux_scan(1, 40, 7).bytes()));
  EXPECT_FALSE(unit.is_taken(lux_scan(1, 40, 7).bytes()));
  EXPECT_FALSE(unit.is_taken(lux_scan(0, 40, 7).bytes()));
  EXPECT_EQ(unit.frozen(), 0U);
}

// It looks back so many packets, and no farther.
TEST(RangeMemory, LooksBackSoManyPackets) {
  RangeMemory memory;
  memory.look_back(192);
  constexpr std::uint64_t kSeen = 0x1234'5678'9ABC'DEF1U;
  EXPECT_FALSE(memory.knows(kSeen));
  memory.note(kSeen);
  for (std::uint32_t since = 0; since < 70'000; ++since) {
    EXPECT_EQ(memory.knows(kSeen), since < 192) << since;
    memory.note(RangeDigest::kNone);
  }
  EXPECT_FALSE(memory.knows(RangeDigest::kNone));
}

}  // namespace
}  // namespace iog::intake
