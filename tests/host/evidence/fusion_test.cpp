// What evidence does to a group: laws, and one cell worked out by hand.
#include "evidence/fusion.hpp"

#include <cstddef>
#include <gtest/gtest.h>

#include "ageing/gains.hpp"
#include "evidence/cell.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/random_group.hpp"

namespace iog::evidence {
namespace {

Gains gains_of(std::uint32_t ms) { return ageing::gains_after(ms, ageing::kGainsByTime); }

Gains random_gains(tests::Random& random) {
  return gains_of(static_cast<std::uint32_t>(random.between(1, 100)));
}

// Random groups after random evidence, with what they were before.
template <typename Check>
void for_each_fusion(std::uint64_t seed, Check&& check) {
  tests::Random random(seed);
  for (int i = 0; i < tests::effort(50'000, 5000); ++i) {
    const Group before = tests::random_group(random);
    const Indexes indexes = tests::random_indexes(random);
    const auto moved = static_cast<std::uint8_t>(random.next());
    Group after = before;
    fuse(after, Fading{}, indexes, moved, random_gains(random));
    for (std::size_t j = 0; j < kGroupCells; ++j) {
      check(cell_of(before, j), cell_of(after, j), indexes[j], ((moved >> j) & 1) != 0);
    }
  }
}

std::int32_t known(const Cell& cell) { return cell.free + cell.taken(); }

TEST(Fusion, KeepsMassesAndTheirSumInRange) {
  for_each_fusion(10, [](const Cell&, const Cell& after, int, bool) {
    ASSERT_GE(after.free, 0);
    ASSERT_GE(after.occupied, 0);
    ASSERT_GE(after.moving, 0);
    ASSERT_GE(after.standing, 0);
    ASSERT_LE(known(after), kCertain);
    ASSERT_GE(after.persistence, 0);
    ASSERT_LE(after.persistence, kCertain);
  });
}

TEST(Fusion, LeavesCellsWithoutEvidenceAlone) {
  for_each_fusion(11, [](const Cell& before, const Cell& after, int index, bool) {
    if (index == 0) {
      ASSERT_EQ(after, before);
    }
  });
}

// Two units are what the rounding of two products may lose.
TEST(Fusion, MovesMassTowardsTheEvidence) {
  for_each_fusion(12, [](const Cell& before, const Cell& after, int index, bool) {
    if (index > 0) {
      ASSERT_LE(after.free, before.free);
      ASSERT_EQ(after.free, before.free * (32'767 - 28'416) / 32'768);
    }
    if (index < 0) {
      ASSERT_GE(after.free, before.free - 2);
      ASSERT_LE(after.taken(), before.taken());
    }
  });
}

// Kurdej 2015, section 5.4: who was not there before and is there now has moved. Nobody else has.
TEST(Fusion, OnlyAHitThatMovedIsMoving) {
  for_each_fusion(13, [](const Cell& before, const Cell& after, int index, bool moved) {
    if (index <= 0 || !moved) {
      ASSERT_LE(after.moving, before.moving);
    }
  });
}

// The same cell, moved or not: the conflict goes to {M} or to what is occupied by whatever.
TEST(Fusion, OfAHitGivesTheConflictToOneOfTwoSets) {
  Gains gains = gains_of(40);
  gains.specialisation = 0;
  Group moved;
  moved.free.fill(20'000);
  moved.occupied.fill(5000);
  Group flicker = moved;
  fuse(moved, Fading{}, Indexes{2, 2, 2, 2, 2, 2, 2, 2}, 0xFF, gains);
  fuse(flicker, Fading{}, Indexes{2, 2, 2, 2, 2, 2, 2, 2}, 0, gains);
  constexpr int kConflict = 20'000 * 28'416 / 32'768;
  EXPECT_EQ(moved.moving[3], kConflict - 1);  // times 32767 / 32768: what is not specialised
  EXPECT_EQ(flicker.moving[3], 0);
  EXPECT_EQ(flicker.occupied[3], moved.occupied[3] + kConflict);
  EXPECT_EQ(flicker.free, moved.free);
  EXPECT_EQ(flicker.persistence, moved.persistence);
}

// A bit of `moved` is that of its cell.
TEST(Fusion, HasABitForEachCell) {
  for (std::size_t cell = 0; cell < kGroupCells; ++cell) {
    Group group;
    group.free.fill(30'000);
    fuse(group, Fading{}, Indexes{2, 2, 2, 2, 2, 2, 2, 2}, static_cast<std::uint8_t>(1U << cell),
         gains_of(40));
    for (std::size_t i = 0; i < kGroupCells; ++i) {
      EXPECT_EQ(group.moving[i] > 0, i == cell) << i;
    }
  }
}

// Free evidence of 100 ms in an unknown cell: f = floor(0.7 2^15) = 22937, of W = 32767.
TEST(Fusion, OfFreeIntoTheUnknown) {
  Group group;
  fuse(group, Fading{}, Indexes{-14}, 0, gains_of(100));
  EXPECT_EQ(cell_of(group, 0), (Cell{.free = 22'936}));  // 32767 * 22937 / 32768 = 22936.3
  EXPECT_EQ(cell_of(group, 1), Cell{});
}

// One hit after 40 ms in an unknown cell, by hand: d = 437, d_gamma = 2621, q = 19661.
//   O' = 32767 * 28416 / 32768 = 28415.1       P' = 28415, its complement 4352
//   gain: 28415 * 32767 / 32768 = 28414, times 437 / 32768 = 378.9, rounded 379
//   loss: 4352 * 2621 / 32768 = 348.1, rounded 348; persistence 31
//   part: 31 * 19661 / 32768 = 18.6; of O' 28415 * 18 / 32768 = 15.6 becomes standing
TEST(Fusion, OfAHitIntoTheUnknown) {
  Group group;
  fuse(group, Fading{}, Indexes{0, 0, 0, 0, 0, 0, 0, 2}, 0x80, gains_of(40));
  EXPECT_EQ(cell_of(group, 7), (Cell{.occupied = 28'400, .standing = 15, .persistence = 31}));
  EXPECT_EQ(cell_of(group, 6), Cell{});
}

// A hit is kept for one free frame of 40 ms, so that what beams meet now and then is not lost: it
// is why a hit is worth 0.87.
TEST(Fusion, OfOneFreeFrameDoesNotEraseAHit) {
  Group group;
  fuse(group, Fading{}, Indexes{2}, 0, gains_of(40));
  age(group, Fading{31'415, 31'289, 31'415, 32'636, 32'636});
  fuse(group, Fading{}, Indexes{-14}, 0, gains_of(40));
  EXPECT_GE(cell_of(group, 0).taken(), 1 << 14);
}

}  // namespace
}  // namespace iog::evidence
