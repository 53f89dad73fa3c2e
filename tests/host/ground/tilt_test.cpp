// The tilt of a packet: that of the second implementation, a line that is put in, and when there is
// none.
#include "ground/tilt.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/random.hpp"
#include "fakes/reference_tilt.hpp"

namespace iog::ground {
namespace {

using tests::Random;
using tests::ReferenceLine;
using tests::ReferenceSample;
using tests::ReferenceTilt;
using Packet = std::vector<ReferenceSample>;

Tilt tilt_of_packet(const Packet& packet, std::int32_t fewest) {
  Samples samples;
  for (const ReferenceSample& its : packet) {
    samples.add(static_cast<std::uint32_t>(its.along_mm), static_cast<std::int32_t>(its.height_mm));
  }
  return tilt_of(samples.all(), fewest);
}

// A road that is tilted, with noise and things on it; or anything at all.
Packet random_packet(Random& random) {
  Packet packet;
  const int count = random.between(0, 128);
  const bool is_road = random.between(0, 3) != 0;
  const double slope = random.between(-60, 60) / 1000.0;
  const std::int32_t up = random.between(-160, 160);
  const std::int32_t noise = random.one_in(3) ? 120 : random.between(0, 40);
  const std::int32_t first = random.one_in(3) ? random.between(2'900, 29'000) : 2'900;
  const std::int32_t last =
      random.one_in(3) ? std::min<std::int32_t>(first + random.between(1'600, 1'800), 30'100)
                       : 30'100;
  for (int i = 0; i < count; ++i) {
    const std::int32_t along = random.between(first, last);
    std::int32_t height =
        up + static_cast<std::int32_t>(slope * along) + random.between(-noise, noise);
    if (!is_road || random.one_in(5)) {
      height = random.one_in(2) ? random.between(-40'000, 40'000) : random.between(-1'500, 1'500);
    }
    packet.push_back({along, height});
  }
  return packet;
}

TEST(Tilt, IsThatOfTheSecondImplementation) {
  Random random(11);
  int tilted = 0;
  for (int i = 0; i < 2'000; ++i) {
    const Packet packet = random_packet(random);
    const std::int32_t fewest = random.one_in(2) ? 24 : 12;
    const ReferenceTilt expected = ReferenceLine().of(packet, fewest);
    const Tilt tilt = tilt_of_packet(packet, fewest);
    ASSERT_EQ(tilt.up_mm, expected.up_mm) << i;
    ASSERT_EQ(tilt.slope, expected.slope) << i;
    tilted += tilt == Tilt{} ? 0 : 1;
  }
  EXPECT_GT(tilted, 300);
}

// Each number of the rule shows in some of these packets.
TEST(Tilt, ATestSeesEachOfItsNumbers) {
  for (int number = 0; number < 9; ++number) {
    tests::TiltRule rule;
    const std::array<tests::Whole*, 9> all{&rule.first_mm,  &rule.end_mm,     &rule.near_mm,
                                           &rule.near_rise, &rule.fits_mm,    &rule.least_spread,
                                           &rule.most_up,   &rule.most_slope, &rule.better};
    tests::Whole& its = *all[static_cast<std::size_t>(number)];
    its += number < 2 ? 16 : 1;  // distances count in units of 16 mm
    if (number == 5) {
      its += 20;  // the spread of a packet's samples is hardly ever just 900
    }
    Random random(11);
    bool is_seen = false;
    for (int i = 0; i < 4'000 && !is_seen; ++i) {
      const Packet packet = random_packet(random);
      const ReferenceTilt expected = ReferenceLine(rule).of(packet, 24);
      const Tilt tilt = tilt_of_packet(packet, 24);
      is_seen = tilt.up_mm != expected.up_mm || tilt.slope != expected.slope;
    }
    EXPECT_TRUE(is_seen) << "number " << number;
  }
}

// A road that rises by a degree: 2^14 tan 1 degree is 286.
TEST(Tilt, OfARoadIsItsSlope) {
  Packet packet;
  for (std::int32_t along = 3'000; along < 30'000; along += 500) {
    packet.push_back({along, (along * 286 >> 14) - 40});
  }
  const Tilt tilt = tilt_of_packet(packet, 24);
  EXPECT_NEAR(tilt.slope, 286, 1);
  EXPECT_NEAR(tilt.up_mm, -40, 2);
  EXPECT_NEAR(tilt.at(20'000), 349 - 40, 3);
}

TEST(Tilt, IsNoneOfFewSamplesOrNearOnesOrNone) {
  const auto road = [](std::int32_t count, std::int32_t apart_mm) {
    Packet packet;
    for (std::int32_t i = 0; i < count; ++i) {
      packet.push_back({5'000 + i * apart_mm, 90 + i * apart_mm / 100});
    }
    return packet;
  };
  EXPECT_NE(tilt_of_packet(road(24, 400), 24), Tilt{});
  EXPECT_EQ(tilt_of_packet(road(23, 400), 24), Tilt{});
  EXPECT_NE(tilt_of_packet(road(12, 400), 12), Tilt{});
  EXPECT_EQ(tilt_of_packet(road(24, 60), 24), Tilt{});
  EXPECT_EQ(tilt_of_packet({}, 24), Tilt{});
}

// What lies on the surface explains itself.
TEST(Tilt, IsNoneWhereItExplainsNoMore) {
  Packet packet;
  for (std::int32_t along = 3'000; along < 30'000; along += 400) {
    packet.push_back({along, along / 400});
  }
  EXPECT_EQ(tilt_of_packet(packet, 24), Tilt{});
}

// The order of samples does not show, and more than a packet can have are left out.
TEST(Tilt, DoesNotMindOrder) {
  Random random(12);
  for (int i = 0; i < 200; ++i) {
    Packet packet = random_packet(random);
    const Tilt tilt = tilt_of_packet(packet, 24);
    for (std::size_t last = packet.size(); last > 1; --last) {
      std::swap(packet[last - 1], packet[random.below(last)]);
    }
    EXPECT_EQ(tilt_of_packet(packet, 24), tilt);
  }
  Samples samples;
  for (int i = 0; i < 1'000; ++i) {
    samples.add(10'000, 0);
  }
  EXPECT_EQ(samples.all().size(), Samples::kMost);
}

}  // namespace
}  // namespace iog::ground
