// What is decided for eight cells at once is what the rules say of each of them. On the Cortex-A9
// this compares NEON with plain integers, over a million random cells.
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>

#include "decision/cell.hpp"
#include "decision/decision.hpp"
#include "evidence/cell.hpp"
#include "fakes/random.hpp"
#include "fakes/random_group.hpp"

namespace iog::decision {
namespace {

constexpr int kGroups = 131'072;  // 1,048,576 cells

// Near the levels, where rounding would show.
void push_to_a_level(tests::Random& random, evidence::Group& group) {
  constexpr std::array<std::int16_t, 6> kLevels{4096, 8192, 16'384, 22'938, 18'432, 30'720};
  for (std::size_t i = 0; i < evidence::kGroupCells; ++i) {
    const auto mass = static_cast<std::int16_t>(kLevels[random.below(kLevels.size())] +
                                                static_cast<int>(random.below(3)) - 1);
    switch (random.below(4)) {
      case 0:
        evidence::put(group, i, {.free = mass, .persistence = mass});
        break;
      case 1:
        evidence::put(group, i, {.moving = mass / 2, .standing = mass - mass / 2});
        break;
      case 2:
        evidence::put(group, i, {.occupied = mass, .persistence = mass});
        break;
      default:
        break;
    }
  }
}

TEST(EightCells, AreDecidedLikeEachOfThem) {
  tests::Random random(31);
  for (int i = 0; i < kGroups; ++i) {
    evidence::Group group = tests::random_group(random);
    if (random.one_in(4)) {
      push_to_a_level(random, group);
    }
    const evidence::Indexes indexes = tests::random_indexes(random);
    alignas(8) const RuledOut ruled_out = tests::random_masks(random);
    alignas(8) Decided decided;
    const Bits bits = decide(group, ruled_out, indexes, decided);
    for (std::size_t j = 0; j < evidence::kGroupCells; ++j) {
      const evidence::Cell cell = evidence::cell_of(group, j);
      ASSERT_EQ(decided[j], byte_of(verdict(cell, mask_of(ruled_out[j]))));
      ASSERT_EQ(bits.freed >> j & 1, cell.free > 16'384);
      ASSERT_EQ(bits.seen >> j & 1, indexes[j] < 0 && cell.free > 22'938);
      ASSERT_EQ(bits.stands >> j & 1, cell.persistence > 4096);
      ASSERT_EQ(bits.taken >> j & 1, cell.taken() > 8192);
      ASSERT_EQ(bits.held >> j & 1, cell.taken() > 0 || cell.persistence > 0);
    }
  }
}

TEST(EightCells, OfWhichNothingIsTakenAreDecidedLikeEachOfThem) {
  tests::Random random(34);
  for (int i = 0; i < kGroups; ++i) {
    evidence::Free free;
    for (std::int16_t& mass : free) {
      mass = random.one_in(4) ? static_cast<std::int16_t>(16'383 + random.below(3))
                              : tests::random_mass(random);
    }
    const evidence::Indexes indexes = tests::random_indexes(random);
    alignas(8) const RuledOut ruled_out = tests::random_masks(random);
    alignas(8) Decided decided;
    const FreeBits bits = decide_free(free, ruled_out, indexes, decided);
    for (std::size_t j = 0; j < evidence::kGroupCells; ++j) {
      ASSERT_EQ(decided[j], byte_of(verdict({.free = free[j]}, mask_of(ruled_out[j]))));
      ASSERT_EQ(bits.freed >> j & 1, free[j] > 16'384);
      ASSERT_EQ(bits.seen >> j & 1, indexes[j] < 0 && free[j] > 22'938);
    }
  }
}

}  // namespace
}  // namespace iog::decision
