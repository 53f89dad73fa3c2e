// The laws of the index fusion, thesis sections 3.3 and 3.4.6, for every width of a cell: what a
// sum of indexes keeps of the fusion of probabilities (section 3.1), and what saturation takes
// away.
#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "index/occupancy_index.hpp"
#include "index/recursive_set.hpp"

namespace iog::index {
namespace {

template <typename Cell>
class IndexFusion : public testing::Test {
 protected:
  static constexpr Cell kMax = kIndexMax<Cell>;
  static constexpr Cell kMin = kIndexMin<Cell>;

  // The limits and what is beside them, 0 and what is beside it, the indexes of table 4.3.
  static std::vector<Cell> samples() {
    const std::array<Cell, 8> positive{1, 2, 7, 14, 15, kMax / 2, kMax - 1, kMax};
    std::vector<Cell> values{0};
    for (const Cell n : positive) {
      values.push_back(n);
      values.push_back(static_cast<Cell>(-n));
    }
    return values;
  }

  static bool is_inside(std::int64_t sum) { return sum >= kMin && sum <= kMax; }
};

struct CellName {
  template <typename Cell>
  static std::string GetName(int) {  // NOLINT(readability-identifier-naming): gtest's word
    return "Int" + std::to_string(8 * sizeof(Cell));
  }
};

using Cells = testing::Types<std::int8_t, std::int16_t, std::int32_t>;
TYPED_TEST_SUITE(IndexFusion, Cells, CellName);

template <typename Cell>
std::int64_t magnitude(Cell n) {
  return n < 0 ? -std::int64_t{n} : std::int64_t{n};
}

// Property 3.4.2. A cell at its limit cannot become surer; it stays where it is.
TYPED_TEST(IndexFusion, ReinforcesIndexesThatAgree) {
  for (const TypeParam a : this->samples()) {
    for (const TypeParam b : this->samples()) {
      if (a > 0 && b > 0) {
        const TypeParam larger = a > b ? a : b;
        EXPECT_TRUE(larger == this->kMax ? sat_add(a, b) == this->kMax : sat_add(a, b) > larger);
      }
      if (a < 0 && b < 0) {
        const TypeParam smaller = a < b ? a : b;
        EXPECT_TRUE(smaller == this->kMin ? sat_add(a, b) == this->kMin : sat_add(a, b) < smaller);
      }
    }
  }
}

// Property 3.4.3, as it must be: the sum of two signs is less sure than the surer of the two.
TYPED_TEST(IndexFusion, MitigatesIndexesThatConflict) {
  for (const TypeParam a : this->samples()) {
    for (const TypeParam b : this->samples()) {
      if (a < 0 && b > 0) {
        EXPECT_LT(magnitude(sat_add(a, b)), std::max(magnitude(a), magnitude(b)));
        EXPECT_GT(sat_add(a, b), a);
        EXPECT_LT(sat_add(a, b), b);
      }
    }
  }
}

// The thesis prints Min where the law holds for Max. One beam that passes and one that ends in a
// cell refute it: -14 and +2 make -12, which is surer than +2.
TYPED_TEST(IndexFusion, DoesNotMitigateBelowTheLessSure) {
  const TypeParam sum = sat_add(TypeParam{-14}, TypeParam{2});
  EXPECT_EQ(sum, -12);
  EXPECT_GT(magnitude(sum), 2);
}

// Property 3.1.4 on indexes; property 3.3.3 is the inverse. These hold at the limits, too.
TYPED_TEST(IndexFusion, HasAnIdentityAndInversesAndCommutes) {
  for (const TypeParam a : this->samples()) {
    EXPECT_EQ(sat_add(a, TypeParam{0}), a);
    EXPECT_EQ(sat_add(a, static_cast<TypeParam>(-a)), 0);
    for (const TypeParam b : this->samples()) {
      EXPECT_EQ(sat_add(a, b), sat_add(b, a));
    }
  }
}

// A group as long as no partial sum meets a limit.
TYPED_TEST(IndexFusion, GroupsFreelyInsideTheRange) {
  for (const TypeParam a : this->samples()) {
    for (const TypeParam b : this->samples()) {
      for (const TypeParam c : this->samples()) {
        const std::int64_t first = std::int64_t{a} + b;
        const std::int64_t last = std::int64_t{b} + c;
        if (this->is_inside(first) && this->is_inside(last) && this->is_inside(first + c)) {
          ASSERT_EQ(sat_add(sat_add(a, b), c), sat_add(a, sat_add(b, c)));
          ASSERT_EQ(sat_add(sat_add(a, b), c), first + c);
        }
      }
    }
  }
}

// And not beyond: what a limit has swallowed does not come back.
TYPED_TEST(IndexFusion, DoesNotGroupFreelyAtALimit) {
  const TypeParam one = 1;
  const TypeParam minus_one = -1;
  EXPECT_EQ(sat_add(sat_add(this->kMax, one), minus_one), this->kMax - 1);
  EXPECT_EQ(sat_add(this->kMax, sat_add(one, minus_one)), this->kMax);
  EXPECT_EQ(sat_add(sat_add(this->kMin, minus_one), one), this->kMin + 1);
  EXPECT_EQ(sat_add(this->kMin, sat_add(minus_one, one)), this->kMin);
}

// docs/model.md section 3, why a frame does not depend on order: of one sign, any grouping gives
// the sum, held to the limit.
TYPED_TEST(IndexFusion, OfOneSignGroupsFreelyEverywhere) {
  for (const TypeParam a : this->samples()) {
    for (const TypeParam b : this->samples()) {
      for (const TypeParam c : this->samples()) {
        const bool is_one_sign = (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
        if (is_one_sign) {
          ASSERT_EQ(sat_add(sat_add(a, b), c), sat_add(a, sat_add(b, c)));
          ASSERT_EQ(sat_add(sat_add(a, b), c), sat_add(sat_add(c, a), b));
        }
      }
    }
  }
}

// Property 3.4.1, incremental: one index after the other is the sum of all, in any order. Sums of
// 64 indexes, which no int8 holds: of one sign they end at the limit in every order; of both signs
// the order does not show in a cell that is wide enough.
TYPED_TEST(IndexFusion, IsIncrementalInAnyOrder) {
  tests::Random random(3);
  for (int round = 0; round < tests::effort(200, 20); ++round) {
    const bool has_one_sign = round % 2 == 0 || sizeof(TypeParam) == 1;
    std::vector<TypeParam> indexes;
    std::int64_t sum = 0;
    for (int i = 0; i < 64; ++i) {
      const bool is_mark = !has_one_sign && random.one_in(3);
      indexes.push_back(is_mark ? TypeParam{2} : static_cast<TypeParam>(random.between(-14, 0)));
      sum += indexes.back();
    }
    const std::int64_t expected = this->is_inside(sum) ? sum : std::int64_t{this->kMin};
    for (int order = 0; order < 4; ++order) {
      TypeParam fused = 0;
      std::vector<TypeParam> rest = indexes;
      while (!rest.empty()) {
        std::swap(rest[random.below(rest.size())], rest.back());
        fused = sat_add(fused, rest.back());
        rest.pop_back();
      }
      ASSERT_EQ(fused, expected);
    }
  }
}

struct Width {
  double epsilon;
  std::int32_t largest;  // a sum of two of these stays away from 1, where 1 - p loses its digits
};

// Theorem 3, and why all of the above is about probabilities: p_m and p_n, fused by equation 3.2,
// are p_(m + n). An epsilon for each width.
TEST(IndexFusionAndProbability, TheSumOfIndexesIsTheFusionOfTheirProbabilities) {
  tests::Random random(5);
  for (const Width width : {Width{0.05, 30}, Width{0.005, 300}, Width{1e-4, 15'000}}) {
    const RecursiveSet set(width.epsilon);
    for (int i = 0; i < tests::effort(2000, 200); ++i) {
      const std::int32_t m = random.between(-width.largest, width.largest);
      const std::int32_t n = random.between(-width.largest, width.largest);
      const double p = set.probability(m);
      const double q = set.probability(n);
      const double fused = p * q / (p * q + (1 - p) * (1 - q));
      ASSERT_NEAR(set.probability(sat_add(m, n)), fused, 1e-11) << m << " + " << n;
    }
  }
}

// What saturation changes: never a cell's side of 1/2, never to the surer.
TEST(IndexFusionAndProbability, SaturationIsOnTheSafeSide) {
  const RecursiveSet set(0.005);
  for (int a = -127; a <= 127; ++a) {
    for (int b = -127; b <= 127; b += tests::effort(1, 9)) {
      const double exact = set.probability(a + b);
      const double stored =
          set.probability(sat_add(static_cast<OccupancyIndex>(a), static_cast<OccupancyIndex>(b)));
      ASSERT_TRUE(exact >= 0.5 ? stored <= exact && stored >= 0.5 : stored >= exact && stored < 0.5)
          << a << " + " << b;
    }
  }
}

}  // namespace
}  // namespace iog::index
