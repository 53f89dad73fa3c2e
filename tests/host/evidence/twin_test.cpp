// What is done to eight cells at once is what evidence/cell.hpp does to each of them. On the
// Cortex-A9 this compares NEON with plain integers, over a million random cells.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>

#include "evidence/cell.hpp"
#include "evidence/fusion.hpp"
#include "fakes/random.hpp"
#include "fakes/random_group.hpp"

namespace iog::evidence {
namespace {

constexpr int kGroups = 131'072;  // 1,048,576 cells

bool operator==(const Group& a, const Group& b) {
  return a.free == b.free && a.occupied == b.occupied && a.moving == b.moving &&
         a.standing == b.standing && a.persistence == b.persistence;
}

// Random groups: eight at once, by `at_once(group)`, and one cell after the other, by
// `one(cell, i)`.
template <typename AtOnce, typename One>
void expect_the_same(tests::Random& random, AtOnce&& at_once, One&& one) {
  Group together = tests::random_group(random);
  Group apart = together;
  at_once(together);
  for (std::size_t i = 0; i < kGroupCells; ++i) {
    put(apart, i, one(cell_of(apart, i), i));
  }
  ASSERT_TRUE(together == apart);
}

Gains random_gains(tests::Random& random) {
  Gains gains;
  gains.free_mass = tests::random_mass(random);
  gains.persistence = tests::random_mass(random);
  gains.decline = tests::random_mass(random);
  gains.specialisation = tests::random_mass(random);
  gains.hit_mass = tests::random_mass(random);
  return gains;
}

std::int16_t random_factor(tests::Random& random) {
  return random.one_in(8) ? kWhole : tests::random_mass(random);
}

Fading random_fading(tests::Random& random) {
  return {random_factor(random), random_factor(random), random_factor(random),
          random_factor(random), random_factor(random)};
}

TEST(EightCells, AgeLikeEachOfThem) {
  tests::Random random(1);
  for (int i = 0; i < kGroups; ++i) {
    const Fading fading = random_fading(random);
    expect_the_same(
        random, [&](Group& group) { age(group, fading); },
        [&](const Cell& cell, std::size_t) { return aged(cell, fading); });
  }
}

TEST(EightCells, AgeAndLearnLikeEachOfThem) {
  tests::Random random(2);
  for (int i = 0; i < kGroups; ++i) {
    const Fading fading = random_fading(random);
    const Gains gains = random_gains(random);
    const Indexes indexes = tests::random_indexes(random);
    const auto moved = static_cast<std::uint8_t>(random.next());
    expect_the_same(
        random, [&](Group& group) { fuse(group, fading, indexes, moved, gains); },
        [&](const Cell& before, std::size_t j) {
          const Cell cell = aged(before, fading);
          const bool has_moved = ((moved >> j) & 1) != 0;
          return indexes[j] == 0 ? cell
                                 : fused(cell, evidence_of(indexes[j], gains), has_moved, gains);
        });
  }
}

// Nothing is taken, and no cell is hit.
TEST(EightCells, ThatAreFreeAloneAgeAndLearnLikeEachOfThem) {
  tests::Random random(33);
  for (int i = 0; i < kGroups; ++i) {
    const Fading fading = random_fading(random);
    const Gains gains = random_gains(random);
    Indexes indexes = tests::random_indexes(random);
    Free free;
    for (std::size_t j = 0; j < kGroupCells; ++j) {
      indexes[j] = std::min<index::OccupancyIndex>(indexes[j], 0);
      free[j] = tests::random_mass(random);
    }
    Free only_older = free;
    Free after = free;
    age_free(only_older, fading);
    fuse_free(after, fading, indexes, gains);
    for (std::size_t j = 0; j < kGroupCells; ++j) {
      const Cell older = aged({.free = free[j]}, fading);
      const Cell expected =
          indexes[j] == 0 ? older : fused(older, evidence_of(indexes[j], gains), false, gains);
      ASSERT_EQ((Cell{.free = only_older[j]}), older);
      ASSERT_EQ((Cell{.free = after[j]}), expected);
    }
  }
}

TEST(EightCells, AgeAndLearnLikeEachOfThemByIndex) {
  tests::Random random(3);
  for (const Assignment& assignment : {kReinforced, kIsopignistic}) {
    for (int i = 0; i < kGroups / 8; ++i) {
      const Fading fading = random_fading(random);
      const Gains gains = random_gains(random);
      const Indexes indexes = tests::random_indexes(random);
      const auto moved = static_cast<std::uint8_t>(random.next());
      expect_the_same(
          random, [&](Group& group) { fuse(group, fading, indexes, moved, gains, assignment); },
          [&](const Cell& before, std::size_t j) {
            const Cell cell = aged(before, fading);
            const Evidence evidence = evidence_of(indexes[j], gains, assignment);
            const bool has_moved = ((moved >> j) & 1) != 0;
            return indexes[j] == 0 ? cell : fused(cell, evidence, has_moved, gains);
          });
    }
  }
}

}  // namespace
}  // namespace iog::evidence
