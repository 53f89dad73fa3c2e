// What a cell is called: ignorance names nothing, and the map never overrules what was seen.
#include "fakes/reference_decision.hpp"

#include <array>
#include <gtest/gtest.h>

namespace iog::tests {
namespace {

TEST(ReferenceDecision, NeedsHalfOfTheMass) {
  EXPECT_EQ(reference_decision({}, kMapSilent).named, CellClass::kUnknown);
  EXPECT_EQ(reference_decision({.free = 0.49, .occupied = 0.49}, kRoad).named, CellClass::kUnknown);
  EXPECT_EQ(reference_decision({.free = 16'384 / 32'767.0}, kMapSilent).named, CellClass::kFree);
  EXPECT_EQ(reference_decision({.free = 16'383 / 32'767.0}, kMapSilent).named, CellClass::kUnknown);
}

// Section 5.3 of the thesis: beside the road, what stopped and what always stands there cannot be
// told apart.
TEST(ReferenceDecision, TakesItsNameFromTheMap) {
  using enum CellClass;
  constexpr std::array kFreeNames{kNonDrivable, kDrivable, kFree, kNonDrivable,
                                  kNonDrivable, kFree,     kFree};
  constexpr std::array kStaticNames{kInfrastructure,    kStopped,           kStoppedOrUnmapped,
                                    kStoppedOrUnmapped, kStoppedOrUnmapped, kStoppedOrUnmapped,
                                    kStoppedOrUnmapped};
  for (unsigned mask = 1; mask <= 7; ++mask) {
    EXPECT_EQ(reference_decision({.free = 0.8}, mask).named, kFreeNames[mask - 1]) << mask;
    EXPECT_EQ(reference_decision({.standing = 0.8}, mask).named, kStaticNames[mask - 1]) << mask;
    EXPECT_EQ(reference_decision({.moving = 0.8}, mask).named, kMoving) << mask;
    EXPECT_EQ(reference_decision({}, mask).named, kUnknown) << mask;
  }
}

// Half of what is not known to move or to stand counts for either. In a building's cell nearly all
// of it stands.
TEST(ReferenceDecision, SharesWhatIsUndecided) {
  const ReferenceCell hit{.occupied = 0.867};
  EXPECT_EQ(reference_decision(hit, kRoad).named, CellClass::kOccupied);
  EXPECT_EQ(reference_decision(hit, kMapSilent).named, CellClass::kOccupied);
  EXPECT_EQ(reference_decision(hit, kBuilding).named, CellClass::kInfrastructure);
  EXPECT_EQ(reference_decision({.occupied = 0.4, .moving = 0.31}, kRoad).named, CellClass::kMoving);
  EXPECT_EQ(reference_decision({.occupied = 0.4, .moving = 0.29}, kRoad).named,
            CellClass::kOccupied);
  EXPECT_EQ(reference_decision({.occupied = 0.4, .moving = 0.31}, kBuilding).named,
            CellClass::kOccupied);
  EXPECT_EQ(reference_decision({.occupied = 0.4, .standing = 0.31}, kRoad).named,
            CellClass::kStopped);
}

// A sixteenth of all mass is a step.
TEST(ReferenceDecision, SaysHowSure) {
  EXPECT_EQ(reference_decision({.free = 0.5001}, kRoad).byte(), 8);
  EXPECT_EQ(reference_decision({.free = 0.57}, kRoad).byte(), 9);
  EXPECT_EQ(reference_decision({.free = 0.93}, kRoad).byte(), 14);
  EXPECT_EQ(reference_decision({.free = 1}, kRoad).byte(), 15);
  EXPECT_EQ(reference_decision({.moving = 0.7}, kRoad).byte(), 4 * 8 + 3);
  EXPECT_EQ(reference_decision({.occupied = 0.9}, kRoad).byte(),
            8 * 8 + 6);  // of all that is occupied
  EXPECT_EQ(reference_decision({.occupied = 0.49}, kRoad).byte(), 0);
}

TEST(ReferenceDecision, KnowsHowNearATieItWas) {
  EXPECT_NEAR(reference_decision({.free = 0.75}, kRoad).margin, 0.25, 1e-4);
  EXPECT_NEAR(reference_decision({.free = 0.1, .moving = 0.53}, kRoad).margin, 0.03, 1e-4);
  // 0.52 of it static, but next to moving, which comes first.
  EXPECT_NEAR(reference_decision({.moving = 0.48, .standing = 0.52}, kRoad).margin, 0.02, 1e-4);
}

TEST(ReferenceDecision, KnowsHowNearAnotherSurenessItWas) {
  const auto margin = [](double units) {
    return reference_decision({.free = units / 32'767}, kRoad).margin_of_sureness() * 32'767;
  };
  EXPECT_NEAR(margin(16'384 + 2048 + 5), 5, 1e-9);
  EXPECT_NEAR(margin(16'384 + 2048 - 5), 5, 1e-9);
  EXPECT_NEAR(margin(16'384 + 10), 2038, 1e-9);  // below one half it has another name
  EXPECT_NEAR(margin(32'767), 16'383 - 7 * 2048, 1e-9);
}

TEST(ReferenceBits, AreStrictlyAboveTheirThresholds) {
  const auto mass = [](int units) { return units / 32'767.0; };
  EXPECT_FALSE(reference_bits({.free = mass(16'384)}, -1).freed);
  EXPECT_TRUE(reference_bits({.free = mass(16'385)}, 1).freed);
  EXPECT_FALSE(reference_bits({.free = mass(22'938)}, -1).seen);
  EXPECT_TRUE(reference_bits({.free = mass(22'939)}, -1).seen);
  EXPECT_FALSE(reference_bits({.free = mass(22'939)}, 0).seen);  // decided without evidence
  EXPECT_FALSE(reference_bits({.persistence = mass(4096)}, 1).stands);
  EXPECT_TRUE(reference_bits({.persistence = mass(4097)}, 1).stands);
  EXPECT_FALSE(reference_bits({.occupied = mass(4096), .standing = mass(4096)}, 1).taken);
  EXPECT_TRUE(reference_bits({.occupied = mass(4096), .standing = mass(4097)}, 1).taken);
}

}  // namespace
}  // namespace iog::tests
