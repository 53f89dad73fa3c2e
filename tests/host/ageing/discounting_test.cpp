// Which sets lose how much (Kurdej 2015, section 6.3, with table 6.1's factors).
#include "ageing/discounting.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace iog::ageing {
namespace {

using evidence::Fading;
using evidence::kWhole;

constexpr std::array kAllDiscountings{Discounting::kConservative, Discounting::kOptimistic,
                                      Discounting::kClassical, Discounting::kProportional};

// 40 ms: 0.90^0.4 = 0.958731 is 31415.7 of 2^-15, 0.99^0.4 = 0.995988 is 32636.5; their product is
// 31289.6; (0.90^0.1) (0.99^0.3) = 0.986540 is 32326.9.
TEST(Discounting, OfOneFrame) {
  EXPECT_EQ(left_after(40, Discounting::kConservative),
            (Fading{31'415, 31'289, 31'415, 32'636, 32'636}));
  EXPECT_EQ(left_after(40, Discounting::kOptimistic),
            (Fading{31'415, kWhole, 31'415, 32'636, 32'636}));
  EXPECT_EQ(left_after(40, Discounting::kClassical),
            (Fading{31'415, 31'415, 31'415, 31'415, 31'415}));
  EXPECT_EQ(left_after(40, Discounting::kProportional),
            (Fading{31'415, 32'326, 31'415, 32'636, 32'636}));
}

// Half of a mass is left after tau ln 2: 658 ms of what moves, 6.897 s of what stands. In one
// millisecond less it is more than half.
TEST(Discounting, HalvesInItsHalfLife) {
  EXPECT_GE(left_after(657, Discounting::kConservative).moving, 1 << 14);
  EXPECT_LT(left_after(658, Discounting::kConservative).moving, 1 << 14);
  EXPECT_GE(left_after(6896, Discounting::kConservative).standing, 1 << 14);
  EXPECT_LT(left_after(6897, Discounting::kConservative).standing, 1 << 14);
}

// A unit of 2^-15, and 47 of 2^-31 for the factors and products of two decays.
TEST(Discounting, IsItsFormulaRoundedDownAtEveryTime) {
  const auto expect = [](double exact, std::int16_t found, std::uint32_t ms) {
    ASSERT_LE(found, exact * 32'768 + 1e-6) << ms;
    ASSERT_GT(found, exact * 32'768 - 1.001) << ms;
  };
  for (std::uint32_t ms = 1; ms <= 65'535; ms += 3) {
    const double moves = std::pow(0.90, ms / 100.0);
    const double stands = std::pow(0.99, ms / 100.0);
    const Fading conservative = left_after(ms, Discounting::kConservative);
    ASSERT_NO_FATAL_FAILURE(expect(moves, conservative.free, ms));
    ASSERT_NO_FATAL_FAILURE(expect(moves * stands, conservative.occupied, ms));
    ASSERT_NO_FATAL_FAILURE(expect(stands, conservative.standing, ms));
    ASSERT_NO_FATAL_FAILURE(expect(std::pow(moves, 0.25) * std::pow(stands, 0.75),
                                   left_after(ms, Discounting::kProportional).occupied, ms));
  }
}

// {I, M, S, U} is what the four differ in, and classical discounting in everything. A set never
// outlives one that a more cautious discounting would leave.
TEST(Discounting, DiffersInWhatIsOccupiedByWhatever) {
  for (std::uint32_t ms = 1; ms <= 65'535; ms += 17) {
    const Fading conservative = left_after(ms, Discounting::kConservative);
    const Fading optimistic = left_after(ms, Discounting::kOptimistic);
    const Fading proportional = left_after(ms, Discounting::kProportional);
    const Fading classical = left_after(ms, Discounting::kClassical);
    ASSERT_EQ(conservative.standing, optimistic.standing);
    ASSERT_EQ(conservative.standing, proportional.standing);
    ASSERT_EQ(conservative.persistence, conservative.standing);
    ASSERT_EQ(conservative.moving, classical.moving);
    ASSERT_EQ(conservative.free, conservative.moving);
    ASSERT_EQ(classical.free, classical.standing);
    ASSERT_EQ(optimistic.occupied, kWhole);
    ASSERT_LE(conservative.occupied, classical.occupied);
    ASSERT_LE(classical.occupied, proportional.occupied);
  }
}

TEST(Discounting, OfNoTimeLeavesEverything) {
  for (const Discounting discounting : kAllDiscountings) {
    EXPECT_EQ(left_after(0, discounting), Fading{});
    EXPECT_EQ(Fading{}.free, kWhole);
  }
}

TEST(Discounting, ForgetsAfterAMinute) {
  for (const Discounting discounting : kAllDiscountings) {
    EXPECT_EQ(left_after(65'536, discounting), (Fading{0, 0, 0, 0, 0}));
    EXPECT_EQ(left_after(0xFFFF'FFFF, discounting), (Fading{0, 0, 0, 0, 0}));
  }
  EXPECT_EQ(left_after(65'535, Discounting::kOptimistic).occupied, kWhole);
}

}  // namespace
}  // namespace iog::ageing
