// How a group fades: nothing grows, nothing is invented, and time may be cut into steps.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <gtest/gtest.h>

#include "ageing/discounting.hpp"
#include "evidence/cell.hpp"
#include "evidence/fusion.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/random_group.hpp"

namespace iog::evidence {
namespace {

using ageing::Discounting;

constexpr std::array kAllDiscountings{Discounting::kConservative, Discounting::kOptimistic,
                                      Discounting::kClassical, Discounting::kProportional};

std::array<std::int32_t, 5> values(const Cell& cell) {
  return {cell.free, cell.occupied, cell.moving, cell.standing, cell.persistence};
}

TEST(Ageing, LetsNothingGrowAndNothingFallBelowZero) {
  tests::Random random(4);
  for (int i = 0; i < tests::effort(20'000, 2000); ++i) {
    const Group before = tests::random_group(random);
    Group after = before;
    const auto ms = static_cast<std::uint32_t>(random.between(0, 70'000));
    age(after, ageing::left_after(ms, kAllDiscountings[random.below(4)]));
    for (std::size_t j = 0; j < kGroupCells; ++j) {
      for (std::size_t k = 0; k < 5; ++k) {
        ASSERT_GE(values(cell_of(after, j))[k], 0);
        ASSERT_LE(values(cell_of(after, j))[k], values(cell_of(before, j))[k]);
      }
    }
  }
}

TEST(Ageing, KeepsTheUnknownUnknown) {
  for (const Discounting discounting : kAllDiscountings) {
    Group group;
    age(group, ageing::left_after(40, discounting));
    for (std::size_t i = 0; i < kGroupCells; ++i) {
      EXPECT_EQ(cell_of(group, i), Cell{});
    }
  }
}

TEST(Ageing, ByNoTimeChangesNothing) {
  tests::Random random(5);
  for (const Discounting discounting : kAllDiscountings) {
    for (int i = 0; i < 100; ++i) {
      const Group before = tests::random_group(random);
      Group after = before;
      age(after, ageing::left_after(0, discounting));
      for (std::size_t j = 0; j < kGroupCells; ++j) {
        ASSERT_EQ(cell_of(after, j), cell_of(before, j));
      }
    }
  }
}

TEST(Ageing, OptimisticallyKeepsWhatIsOccupiedByWhatever) {
  tests::Random random(6);
  Group group = tests::random_group(random);
  const Masses occupied = group.occupied;
  age(group, ageing::left_after(30'000, Discounting::kOptimistic));
  EXPECT_EQ(group.occupied, occupied);
}

TEST(Ageing, OfMoreThanAMinuteForgetsEverything) {
  tests::Random random(7);
  Group group = tests::random_group(random);
  age(group, ageing::left_after(65'536, Discounting::kOptimistic));
  for (std::size_t i = 0; i < kGroupCells; ++i) {
    EXPECT_EQ(cell_of(group, i), Cell{});
  }
}

// Each ageing loses less than one unit by the rounded factor and less than one by the rounded mass,
// and later ageings only shrink what was lost. So n steps differ from one by less than 2 n + 2.
TEST(Ageing, InStepsDiffersFromOneByRoundingAlone) {
  tests::Random random(8);
  for (int i = 0; i < tests::effort(2000, 200); ++i) {
    const Discounting discounting = kAllDiscountings[random.below(4)];
    const Group start = tests::random_group(random);
    Group by_steps = start;
    std::uint32_t elapsed = 0;
    const int steps = random.between(1, 100);
    for (int step = 0; step < steps; ++step) {
      const auto ms = static_cast<std::uint32_t>(random.between(0, 120));
      age(by_steps, ageing::left_after(ms, discounting));
      elapsed += ms;
    }
    Group at_once = start;
    age(at_once, ageing::left_after(elapsed, discounting));
    for (std::size_t j = 0; j < kGroupCells; ++j) {
      for (std::size_t k = 0; k < 5; ++k) {
        const std::int32_t difference =
            values(cell_of(by_steps, j))[k] - values(cell_of(at_once, j))[k];
        ASSERT_LT(std::abs(difference), 2 * steps + 2) << steps << " steps, value " << k;
      }
    }
  }
}

}  // namespace
}  // namespace iog::evidence
