// What is decided for eight cells at once is what the rules say of each of them. On the Cortex-A9
// this compares NEON with plain integers, over a million random cells.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>

#include "decision/cell.hpp"
#include "decision/decision.hpp"
#include "evidence/cell.hpp"
#include "evidence/fusion.hpp"
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

evidence::Fading random_fading(tests::Random& random) {
  return {.free = random.one_in(8) ? evidence::kWhole : tests::random_mass(random)};
}

evidence::Gains random_gains(tests::Random& random) {
  evidence::Gains gains;
  gains.free_mass = tests::random_mass(random);
  return gains;
}

// Groups at once, through which beams go and of which nothing is taken. Fused and decided one by
// one, by the other functions of this machine and by the rules for one cell.
template <std::size_t kCount>
void expect_crossed_like_each(tests::Random& random) {
  const evidence::Fading fading = random_fading(random);
  const evidence::Gains gains = random_gains(random);
  std::array<evidence::Free, kCount> free;
  alignas(8) std::array<evidence::Indexes, kCount> indexes;
  alignas(8) std::array<RuledOut, kCount> ruled_out;
  alignas(8) std::array<Decided, kCount> decided{};
  std::array<evidence::Free, kCount> expected;
  for (std::size_t j = 0; j < kCount; ++j) {
    for (std::int16_t& mass : free[j]) {
      mass = tests::random_mass(random);
    }
    indexes[j] = tests::random_indexes(random);
    for (index::OccupancyIndex& index : indexes[j]) {
      index = std::min(index, index::kUnknown);
    }
    ruled_out[j] = tests::random_masks(random);
    evidence::Taken nothing;
    expected[j] = free[j];
    evidence::fuse(expected[j], nothing, fading, indexes[j], 0, gains);
  }
  const std::uint64_t bits = cross_free<kCount>({.free = free.data(),
                                                 .fading = &fading,
                                                 .indexes = indexes.data(),
                                                 .gains = &gains,
                                                 .ruled_out = ruled_out.data(),
                                                 .decided = decided.data()});
  for (std::size_t j = 0; j < kCount; ++j) {
    ASSERT_EQ(free[j], expected[j]);
    for (std::size_t k = 0; k < evidence::kGroupCells; ++k) {
      ASSERT_EQ(decided[j][k], byte_of(verdict({.free = free[j][k]}, mask_of(ruled_out[j][k]))));
      ASSERT_EQ(bits >> (8 * j + k) & 1, free[j][k] > 16'384);
      ASSERT_EQ(bits >> (32 + 8 * j + k) & 1, indexes[j][k] < 0 && free[j][k] > 22'938);
    }
  }
}

TEST(EightCells, OfTwoOrFourGroupsAreCrossedLikeThoseOfEach) {
  tests::Random random(35);
  for (int i = 0; i < kGroups && !testing::Test::HasFatalFailure(); ++i) {
    expect_crossed_like_each<2>(random);
    expect_crossed_like_each<4>(random);
  }
}

}  // namespace
}  // namespace iog::decision
