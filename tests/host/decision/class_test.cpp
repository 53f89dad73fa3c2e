// Masses to a class: the names, the levels, and what has none.
#include <array>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>

#include "decision/decision.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/random_group.hpp"
#include "lab/reference/cell.hpp"
#include "lab/reference/cell_decision.hpp"

namespace iog::decision {
namespace {

using evidence::Group;
using evidence::Indexes;

struct Masses {
  std::int16_t free = 0;
  std::int16_t occupied = 0;
  std::int16_t moving = 0;
  std::int16_t standing = 0;
};

// The byte of a cell where the map leaves the classes of `mask`, decided in each place of a group.
int decided(const Masses& masses, std::uint8_t mask = kAnywhere) {
  Group group;
  group.free.fill(masses.free);
  group.occupied.fill(masses.occupied);
  group.moving.fill(masses.moving);
  group.standing.fill(masses.standing);
  alignas(8) RuledOut ruled_out;
  ruled_out.fill(static_cast<std::uint8_t>(kAnywhere - mask));
  alignas(8) Decided decided;
  decide(group, ruled_out, Indexes{}, decided);
  for (const std::int8_t byte : decided) {
    EXPECT_EQ(byte, decided[0]);
  }
  return decided[0];
}

int byte_of(Class name, int level) { return static_cast<int>(name) * 8 + level; }

// What a cell is called by what the map leaves possible there, from mask 0 to mask 7.
std::string names(const Masses& masses) {
  constexpr std::array<const char*, 9> kNames{
      "unknown", "drivable", "non-drivable",        "free",
      "moving",  "stopped",  "stopped or unmapped", "infrastructure",
      "occupied"};
  std::string all;
  for (std::uint8_t mask = 0; mask <= kAnywhere; ++mask) {
    all += std::string(kNames.at(static_cast<std::size_t>(decided(masses, mask)) / 8)) + "\n";
  }
  return all;
}

// Kurdej 2015, section 5.3: stopped things and unmapped infrastructure cannot be told apart where
// both may be. Mask 0, nothing possible, names as little as mask 7.
TEST(Names, FollowTheMap) {
  EXPECT_EQ(names({.free = 20'000}),
            "free\n"          // nothing possible
            "non-drivable\n"  // building
            "drivable\n"      // road
            "free\n"          // building or road
            "non-drivable\n"  // beside the roads
            "non-drivable\n"  // building, or beside the roads
            "free\n"          // road, or beside the roads
            "free\n");        // anywhere
  EXPECT_EQ(names({.standing = 20'000}),
            "stopped or unmapped\n"
            "infrastructure\n"
            "stopped\n"
            "stopped or unmapped\n"
            "stopped or unmapped\n"
            "stopped or unmapped\n"
            "stopped or unmapped\n"
            "stopped or unmapped\n");
}

TEST(Names, OfWhatMovesNeedNoMap) {
  for (std::uint8_t mask = 0; mask <= kAnywhere; ++mask) {
    EXPECT_EQ(decided({.moving = 20'000}, mask), byte_of(Class::kMoving, 1)) << int{mask};
    EXPECT_EQ(decided({.occupied = 10'000, .moving = 6000, .standing = 6000}, mask),
              byte_of(Class::kOccupied, 2))
        << int{mask};
    EXPECT_EQ(decided({}, mask), 0) << int{mask};
  }
}

// Half of what is occupied by whatever counts as moving; in a building 2 of 256 parts do.
TEST(Class, OfWhatIsOccupiedByWhateverDependsOnTheBuilding) {
  EXPECT_EQ(decided({.occupied = 32'766}), byte_of(Class::kOccupied, 7));
  EXPECT_EQ(decided({.occupied = 32'767}), byte_of(Class::kStoppedOrUnmapped, 0));
  EXPECT_EQ(decided({.occupied = 17'000}, kRoad), byte_of(Class::kOccupied, 0));
  // 17000 * 2 / 256 = 132.8 may move, the other 16868 stand.
  EXPECT_EQ(decided({.occupied = 17'000}, kBuilding), byte_of(Class::kInfrastructure, 0));
}

// A level is 2048 of 32768 above one half.
TEST(Class, IsAsSureAsItsMass) {
  for (int mass = 0; mass <= evidence::kCertain; ++mass) {
    const auto value = static_cast<std::int16_t>(mass);
    const bool is_named = mass >= 16'384;
    const int level = is_named ? (mass - 16'384) / 2048 : 0;
    ASSERT_EQ(decided({.free = value}), is_named ? byte_of(Class::kFree, level) : 0) << mass;
    ASSERT_EQ(decided({.moving = value}), is_named ? byte_of(Class::kMoving, level) : 0) << mass;
    ASSERT_EQ(decided({.standing = value}),
              is_named ? byte_of(Class::kStoppedOrUnmapped, level) : 0)
        << mass;
  }
}

// What is known to be occupied, but neither to move nor to stand, is sure by all of its mass.
TEST(Class, OfWhatIsOccupiedIsSureByAllThatIsTaken) {
  EXPECT_EQ(decided({.moving = 16'000, .standing = 16'000}), byte_of(Class::kOccupied, 7));
  EXPECT_EQ(decided({.moving = 8192, .standing = 8192}), byte_of(Class::kOccupied, 0));
  EXPECT_EQ(decided({.moving = 8191, .standing = 8192}), 0);
}

// Whatever a cell is called has at least half of all mass behind it.
TEST(Class, IsNeverNamedByIgnorance) {
  tests::Random random(30);
  for (int i = 0; i < tests::effort(50'000, 5000); ++i) {
    const Group group = tests::random_group(random);
    alignas(8) const RuledOut ruled_out = tests::random_masks(random);
    alignas(8) Decided decided;
    decide(group, ruled_out, Indexes{}, decided);
    for (std::size_t j = 0; j < evidence::kGroupCells; ++j) {
      const auto name = static_cast<Class>(decided[j] / 8);
      const int taken = group.occupied[j] + group.moving[j] + group.standing[j];
      const bool is_free =
          name == Class::kDrivable || name == Class::kNonDrivable || name == Class::kFree;
      ASSERT_EQ(is_free, group.free[j] >= 16'384);
      ASSERT_EQ(!is_free && name != Class::kUnknown, taken >= 16'384);
    }
  }
}

// In every mask what real numbers say, but where less than two units would change it.
TEST(Class, IsThatOfTheReference) {
  constexpr double kTwoUnits = 2.0 / evidence::kCertain;
  tests::Random random(32);
  int compared = 0;
  for (int i = 0; i < tests::effort(50'000, 5000); ++i) {
    const Group group = tests::random_group(random);
    alignas(8) const RuledOut ruled_out = tests::random_masks(random);
    alignas(8) Decided decided;
    decide(group, ruled_out, Indexes{}, decided);
    for (std::size_t j = 0; j < evidence::kGroupCells; ++j) {
      const unsigned mask = kAnywhere - ruled_out[j];
      const auto exact = reference_decision(reference_cell(group, j), mask);
      if (exact.margin < kTwoUnits || exact.margin_of_sureness() < kTwoUnits) {
        continue;
      }
      ASSERT_EQ(decided[j], exact.byte()) << "mask " << mask;
      ++compared;
    }
  }
  EXPECT_GT(compared, tests::effort(50'000, 5000) * 4);
}

}  // namespace
}  // namespace iog::decision
