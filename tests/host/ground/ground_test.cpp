// When a sensor's ground is renewed, and when it is forgotten.
#include "ground/ground.hpp"

#include <gtest/gtest.h>
#include <memory>

#include "fakes/ground_car.hpp"
#include "fakes/ground_turns.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "tools/car/tables.hpp"

namespace iog::ground {
namespace {

using LowsAre = Grounds::LowsAre;

struct Bench {
  tests::GroundCar car{tests::MixedCar::kVehicle};
  std::unique_ptr<Grounds> grounds = std::make_unique<Grounds>(car.vehicle());
  std::uint32_t turn_ticks = car.vehicle().sensors[0].scan_width_ticks;
};

TEST(Grounds, AreOfSensorsThatFollowThem) {
  const Bench bench;
  EXPECT_EQ(bench.grounds->place_of(0), 0U);
  EXPECT_EQ(bench.grounds->place_of(1), 1U);
  EXPECT_EQ(bench.grounds->place_of(2), std::nullopt);  // a LUX
  const auto flat = std::make_unique<Grounds>(tests::MixedCar::kVehicle);
  EXPECT_EQ(flat->place_of(0), std::nullopt);
}

// Whatever part of a turn a frame has; of each sensor apart.
TEST(Grounds, AreRenewedAfterATurn) {
  const Bench bench;
  for (int turn = 0; turn < 3; ++turn) {
    EXPECT_EQ(bench.grounds->end_frame(0, bench.turn_ticks / 3), LowsAre::kKept);
    EXPECT_EQ(bench.grounds->end_frame(1, bench.turn_ticks), LowsAre::kOfTurn);
    EXPECT_EQ(bench.grounds->end_frame(0, bench.turn_ticks / 3), LowsAre::kKept);
    EXPECT_EQ(bench.grounds->end_frame(0, bench.turn_ticks / 2), LowsAre::kOfTurn);
  }
  EXPECT_EQ(bench.grounds->end_frame(0, bench.turn_ticks), LowsAre::kOfTurn);
}

// What opens ground is at most 0.6 m high over it here, and a beam counts between 0.22 and 2.2 m. A
// sensor that is higher has low beams only from where they come down to 0.6 m; one that is lower
// from its own place to where they rise over it; one for which any height opens all the way. Beams
// that are lower than 0.3 m may pass under a car, but one that is so low has no others.
TEST(Ground, BeamsAreLowWhereTheyAreAtMostAsHighAsOpensIt) {
  constexpr double kSine = 0.267949;  // of 15 degrees, by its cosine: along the line
  const auto stretch = [](double sensor_m, vehicle::MovedLimits moved, std::size_t layer) {
    description::SensorConfig config = tests::test_vlp16(100, {.z_m = sensor_m});
    vehicle::Vehicle car = tests::LevelVlp16::kVehicle;
    const std::array sensors{description::sensor_of(config, tests::LevelVlp16::kDescription)};
    car.sensors = sensors;
    const tests::GroundCar followed(car, {220, 2'200}, moved);
    const auto grounds = std::make_unique<Grounds>(followed.vehicle());
    return tests::ground_of(*grounds, 0).low_stretch(0, layer);
  };
  constexpr std::size_t kDown = 0;
  constexpr std::size_t kUp = 15;
  constexpr vehicle::MovedLimits kSixty{.low_mm = 600, .tall_mm = 600};
  const Ground::Stretch high_down = stretch(1.5, kSixty, kDown);
  EXPECT_NEAR(high_down.from_mm, 900 / kSine, 4);
  EXPECT_NEAR(high_down.to_mm, 1'200 / kSine, 4);
  const Ground::Stretch low_up = stretch(0.5, kSixty, kUp);
  EXPECT_EQ(low_up.from_mm, 0U);
  EXPECT_NEAR(low_up.to_mm, 100 / kSine, 4);
  const Ground::Stretch low_down = stretch(0.5, kSixty, kDown);
  EXPECT_EQ(low_down.from_mm, 0U);
  EXPECT_NEAR(low_down.to_mm, 200 / kSine, 4);
  const Ground::Stretch on_border = stretch(0.6, kSixty, kDown);
  EXPECT_EQ(on_border.from_mm, 0U);
  EXPECT_NEAR(on_border.to_mm, 300 / kSine, 4);
  const Ground::Stretch under_cars = stretch(0.3, kSixty, kDown);
  EXPECT_EQ(under_cars.from_mm, 0U);
  EXPECT_NEAR(under_cars.to_mm, 80 / kSine, 4);
  const Ground::Stretch any = stretch(1.5, {}, kUp);
  EXPECT_EQ(any.from_mm, 0U);
  EXPECT_NEAR(any.to_mm, 700 / kSine, 4);
}

// A bank of 0.2 m: a beam that has come down to 0.6 m over it is at 0.8 m over the road before it,
// and does not open it yet. Where the bank has begun long before, it does.
TEST(Ground, ABeamIsLowOverTheLowestGroundNearby) {
  const tests::GroundCar car{
      tests::MixedCar::kVehicle, {220, 2'200}, {.low_mm = 600, .tall_mm = 500}};
  const auto grounds = std::make_unique<Grounds>(car.vehicle());
  const Ground& ground = tests::ground_of(*grounds, 0);
  const Bins bins = ground.beams().bins();
  constexpr std::size_t kDown = 12;  // by 3 degrees
  const double slope = ground.beams().slope(kDown) / static_cast<double>(1 << 24);
  ASSERT_LT(slope, 0);
  const auto low_from = [&](std::int32_t rise_mm, std::uint32_t foot) {
    Lows lows;
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
      for (std::uint32_t number = 0; number < 60; ++number) {
        lows.add(bins, sector, number * bins.length_mm() + bins.length_mm() / 2,
                 number < foot ? 0 : rise_mm);
      }
    }
    grounds->close_turn(0, lows);
    return ground.low_stretch(100, kDown).from_mm;
  };
  const double over_road_mm = 900 / -slope;
  EXPECT_NEAR(low_from(0, 60), over_road_mm, 3);
  // Where the beam is so low over the road, the ground has begun to rise: over three starts by 0,
  // 100 and 200 mm, of which two sixths of 100 mm are a slope for the one in the middle.
  const auto foot = static_cast<std::uint32_t>(over_road_mm) / bins.length_mm();
  EXPECT_LE(low_from(200, foot), over_road_mm + 3);
  EXPECT_GE(low_from(200, foot), over_road_mm - 34 / -slope);
  // Where it has risen long before, the beam is low over the bank.
  EXPECT_NEAR(low_from(200, foot - 6), 700 / -slope, 3);
}

// From where on a return is tall where a bin begins, over the ground of that place, in mm. The
// ground is at 0 up to the middle of bin 19 and at `rise_mm` from that of bin 20 on.
std::int32_t tall_from(std::int32_t rise_mm, std::uint32_t bin, std::uint16_t tall_mm) {
  const tests::GroundCar car{
      tests::MixedCar::kVehicle, {220, 2'200}, {.low_mm = 600, .tall_mm = tall_mm}};
  const auto grounds = std::make_unique<Grounds>(car.vehicle());
  const Ground& ground = tests::ground_of(*grounds, 0);
  const Bins bins = ground.beams().bins();
  Lows lows;
  for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
    for (std::uint32_t number = 0; number < 40; ++number) {
      lows.add(bins, sector, number * bins.length_mm() + bins.length_mm() / 2,
               number < 20 ? 0 : rise_mm);
    }
  }
  grounds->close_turn(0, lows);
  const PacketJudge judge(ground, lows, {});
  const std::uint32_t along_mm = bin * bins.length_mm();
  const std::int32_t ground_mm = -ground.surface().height_over(bins, 100, along_mm, 0);
  std::int32_t over_mm = 0;
  while (over_mm < 2'000 && !judge.judge(100, along_mm, ground_mm + over_mm).is_tall) {
    ++over_mm;
  }
  return over_mm;
}

// A walker on flat ground, beside a kerb of 12 cm, and where a bank begins, whose own returns are
// no more than it is high: also beside a drop. Three bins before it and on top of it the bank does
// not count.
TEST(PacketJudge, WhatIsTallIsSoOverTheHighestGroundNearby) {
  for (const std::uint16_t tall_mm : {std::uint16_t{300}, std::uint16_t{500}}) {
    for (const std::uint32_t bin : {10U, 19U, 20U, 30U}) {
      EXPECT_EQ(tall_from(0, bin, tall_mm), tall_mm);
    }
    EXPECT_EQ(tall_from(120, 19, tall_mm), tall_mm + 120);
    EXPECT_EQ(tall_from(200, 17, tall_mm), tall_mm);
    EXPECT_EQ(tall_from(200, 18, tall_mm), tall_mm + 100);  // half way up the slope
    EXPECT_EQ(tall_from(200, 19, tall_mm), tall_mm + 200);
    EXPECT_EQ(tall_from(200, 21, tall_mm), tall_mm);
    EXPECT_EQ(tall_from(-200, 19, tall_mm), tall_mm);
    EXPECT_EQ(tall_from(-200, 21, tall_mm), tall_mm + 200);
    EXPECT_EQ(tall_from(-200, 23, tall_mm), tall_mm);
  }
}

// A wall on ground that rises or falls by 15 %: what of it is 3 m over or under the car's plane or
// more has no sure place.
TEST(PacketJudge, WhatIsFarOffTheCarsPlaneIsNotTall) {
  for (const std::int32_t sign : {1, -1}) {
    const tests::GroundCar car{
        tests::MixedCar::kVehicle, {220, 2'200}, {.low_mm = 600, .tall_mm = 500}};
    const auto grounds = std::make_unique<Grounds>(car.vehicle());
    const Ground& ground = tests::ground_of(*grounds, 0);
    const Bins bins = ground.beams().bins();
    const auto length = static_cast<std::int32_t>(bins.length_mm());
    Lows lows;
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
      for (std::int32_t number = 0; number < 40; ++number) {
        const std::int32_t along_mm = number * length + length / 2;
        lows.add(bins, sector, static_cast<std::uint32_t>(along_mm), sign * along_mm * 15 / 100);
      }
    }
    grounds->close_turn(0, lows);
    const PacketJudge judge(ground, lows, {});
    const auto is_tall = [&](std::int32_t along_mm, std::int32_t z_mm) {
      const auto judged = judge.judge(100, static_cast<std::uint32_t>(along_mm), z_mm);
      EXPECT_EQ(judged.fate, vehicle::Fate::kUsed) << along_mm << ", " << z_mm;
      return judged.is_tall;
    };
    const auto foot = [sign](std::int32_t along_mm) { return sign * along_mm * 15 / 100; };
    EXPECT_TRUE(is_tall(10'000, foot(10'000) + 1'300));
    if (sign > 0) {
      EXPECT_TRUE(is_tall(12'000, 3'000));
      EXPECT_FALSE(is_tall(12'000, 3'001));
      EXPECT_FALSE(is_tall(20'000, foot(20'000) + 1'300));
    } else {
      EXPECT_TRUE(is_tall(28'000, -3'000));
      EXPECT_FALSE(is_tall(28'000, -3'001));
      EXPECT_FALSE(is_tall(36'000, foot(36'000) + 1'300));
    }
  }
}

// With a tall_m of 0 whatever is hit is tall, before a bank, too.
TEST(PacketJudge, EachReturnIsTallIfTheCarSaysSo) { EXPECT_EQ(tall_from(200, 19, 0), 0); }

// Whatever becomes of it.
TEST(PacketJudge, EachReturnIsAmongTheLows) {
  const Bench bench;
  const Ground& ground = tests::ground_of(*bench.grounds, 0);
  Lows lows;
  const PacketJudge judge(ground, lows, {});
  Lows expected;
  for (const std::int32_t z_mm : {-900, -10, 300, 9'000}) {
    const auto along_mm = static_cast<std::uint32_t>(10'000 + z_mm);
    static_cast<void>(judge.judge(7, along_mm, z_mm));
    expected.add(ground.beams().bins(), 7, along_mm, z_mm);
  }
  EXPECT_TRUE(lows == expected);
  EXPECT_FALSE(lows == Lows());
}

// Frames of 40 ms: 25 of them are a second.
TEST(Grounds, AreForgottenWhenASensorIsSilent) {
  const Bench bench;
  tests::Random random(1);
  Lows lows;
  for (const tests::Return& its : tests::rough_turn(random, 1'024)) {
    lows.add(tests::ground_of(*bench.grounds, 0).beams().bins(),
             static_cast<std::uint32_t>(its.sector), static_cast<std::uint32_t>(its.along_mm),
             its.z_mm);
  }
  EXPECT_EQ(bench.grounds->end_frame(0, bench.turn_ticks), LowsAre::kOfTurn);
  bench.grounds->close_turn(0, lows);
  EXPECT_FALSE(tests::ground_of(*bench.grounds, 0).surface() == Surface());
  for (int frame = 0; frame < 24; ++frame) {
    EXPECT_EQ(bench.grounds->end_frame(0, 0), LowsAre::kKept);
  }
  EXPECT_FALSE(tests::ground_of(*bench.grounds, 0).surface() == Surface());
  EXPECT_EQ(bench.grounds->end_frame(0, 0), LowsAre::kForgotten);
  EXPECT_TRUE(tests::ground_of(*bench.grounds, 0).surface() == Surface());
  EXPECT_EQ(bench.grounds->end_frame(0, 0), LowsAre::kKept);
  EXPECT_EQ(bench.grounds->end_frame(0, bench.turn_ticks), LowsAre::kOfTurn);
}

}  // namespace
}  // namespace iog::ground
