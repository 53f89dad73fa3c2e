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

// Two groups at once, through which beams go and of which nothing is taken.
TEST(EightCells, OfTwoGroupsAreCrossedLikeThoseOfEach) {
  struct Sample {
    explicit Sample(tests::Random& random)
        : fading(random_fading(random)),
          indexes(tests::random_indexes(random)),
          gains(random_gains(random)),
          ruled_out(tests::random_masks(random)) {
      for (std::int16_t& mass : free) {
        mass = tests::random_mass(random);
      }
      for (index::OccupancyIndex& index : indexes) {
        index = std::min(index, index::kUnknown);
      }
    }
    evidence::Free free;
    evidence::Fading fading;
    alignas(8) evidence::Indexes indexes;
    evidence::Gains gains;
    alignas(8) RuledOut ruled_out;
    alignas(8) Decided decided{};
  };
  tests::Random random(35);
  for (int i = 0; i < kGroups; ++i) {
    std::array<Sample, 2> samples{Sample(random), Sample(random)};
    std::array<Crossed, 2> crossed{};
    std::array<evidence::Free, 2> expected;
    for (std::size_t j = 0; j < samples.size(); ++j) {
      Sample& of = samples[j];
      crossed[j] = {.free = &of.free,
                    .fading = &of.fading,
                    .indexes = &of.indexes,
                    .gains = &of.gains,
                    .ruled_out = &of.ruled_out,
                    .decided = &of.decided};
      evidence::Taken nothing;
      expected[j] = of.free;
      evidence::fuse(expected[j], nothing, of.fading, of.indexes, 0, of.gains);
    }
    const std::array<FreeBits, 2> bits = cross_free(crossed);
    for (std::size_t j = 0; j < samples.size(); ++j) {
      const Sample& of = samples[j];
      ASSERT_EQ(of.free, expected[j]);
      for (std::size_t k = 0; k < evidence::kGroupCells; ++k) {
        ASSERT_EQ(of.decided[k], byte_of(verdict({.free = of.free[k]}, mask_of(of.ruled_out[k]))));
        ASSERT_EQ(bits[j].freed >> k & 1, of.free[k] > 16'384);
        ASSERT_EQ(bits[j].seen >> k & 1, of.indexes[k] < 0 && of.free[k] > 22'938);
      }
    }
  }
}

}  // namespace
}  // namespace iog::decision
