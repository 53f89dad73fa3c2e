// When a sensor's ground is renewed, and when it is forgotten.
#include "ground/ground.hpp"

#include <gtest/gtest.h>
#include <memory>

#include "fakes/ground_car.hpp"
#include "fakes/ground_turns.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"

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
