// The rules of combination against hand calculation, against their other definitions by commonality
// and belief, and against what the literature knows of them.
#include "lab/reference/evidential/mass_function.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "lab/reference/evidential/random_mass.hpp"

namespace iog::lab::reference::evidential {
namespace {

using tests::largest_difference;
using tests::Random;
using tests::random_mass;

constexpr Set kA = 1;
constexpr Set kB = 2;
constexpr Set kC = 4;

// q(A), all mass that does not speak against A (thesis section 3.4).
double commonality(const MassFunction& mass, Set of) {
  double sum = 0;
  for (Set a = 0; a <= mass.frame(); ++a) {
    sum += is_subset(of, a) ? mass[a] : 0;
  }
  return sum;
}

// b(A), implicability: all mass within A, that of the empty set included.
double implicability(const MassFunction& mass, Set of) {
  double sum = 0;
  for (Set a = 0; a <= mass.frame(); ++a) {
    sum += is_subset(a, of) ? mass[a] : 0;
  }
  return sum;
}

TEST(MassFunction, GivesTheRestToTheFrame) {
  EXPECT_EQ(MassFunction(3)[kA | kB | kC], 1);
  const MassFunction mass(3, {{kA, 0.25}, {kA | kB, 0.5}});
  EXPECT_EQ(mass[kA], 0.25);
  EXPECT_EQ(mass[kA | kB], 0.5);
  EXPECT_EQ(mass[kA | kB | kC], 0.25);
  EXPECT_EQ(mass.total(), 1);
  EXPECT_EQ(mass.committed(), 0.75);
  EXPECT_EQ(MassFunction::empty(3).total(), 0);
}

TEST(ConjunctiveRule, ByHand) {
  const MassFunction one(2, {{kA, 0.5}});
  const MassFunction other(2, {{kB, 0.25}});
  const MassFunction fused = conjunctive(one, other);
  EXPECT_EQ(fused[0], 0.125);
  EXPECT_EQ(fused[kA], 0.375);
  EXPECT_EQ(fused[kB], 0.125);
  EXPECT_EQ(fused[kA | kB], 0.375);
}

// Equation 3.42.
TEST(ConjunctiveRule, MultipliesCommonalities) {
  Random random(1);
  for (int round = 0; round < 50; ++round) {
    const MassFunction one = random_mass(random, 5);
    const MassFunction other = random_mass(random, 5);
    const MassFunction fused = conjunctive(one, other);
    for (Set a = 0; a <= one.frame(); ++a) {
      ASSERT_NEAR(commonality(fused, a), commonality(one, a) * commonality(other, a), 1e-14);
    }
  }
}

TEST(DisjunctiveRule, ByHand) {
  const MassFunction one(3, {{kA, 0.5}, {kB, 0.5}});
  const MassFunction other(3, {{kA, 0.25}, {kC, 0.75}});
  const MassFunction fused = disjunctive(one, other);
  EXPECT_EQ(fused[kA], 0.125);
  EXPECT_EQ(fused[kA | kC], 0.375);
  EXPECT_EQ(fused[kA | kB], 0.125);
  EXPECT_EQ(fused[kB | kC], 0.375);
}

// Equation 3.44.
TEST(DisjunctiveRule, MultipliesImplicabilities) {
  Random random(2);
  for (int round = 0; round < 50; ++round) {
    const MassFunction one = random_mass(random, 5);
    const MassFunction other = random_mass(random, 5);
    const MassFunction fused = disjunctive(one, other);
    for (Set a = 0; a <= one.frame(); ++a) {
      ASSERT_NEAR(implicability(fused, a), implicability(one, a) * implicability(other, a), 1e-14);
    }
  }
}

// Zadeh's patient (1979): two doctors who agree only on what both think next to impossible. After
// Dempster it is certain, after Yager nothing is known.
TEST(ConflictRules, DifferOnZadehsPatient) {
  const MassFunction one(3, {{kA, 0.99}, {kB, 0.01}});
  const MassFunction other(3, {{kC, 0.99}, {kB, 0.01}});
  EXPECT_NEAR(conjunctive(one, other)[0], 0.9999, 1e-15);
  EXPECT_NEAR(dempster(one, other)[kB], 1, 1e-12);
  EXPECT_NEAR(yager(one, other)[kB], 0.0001, 1e-15);
  EXPECT_NEAR(yager(one, other)[kA | kB | kC], 0.9999, 1e-15);
}

TEST(DempstersRule, IsAssociativeAndYagersIsNot) {
  Random random(3);
  double worst = 0;
  for (int round = 0; round < 50; ++round) {
    const MassFunction one = random_mass(random, 4);
    const MassFunction other = random_mass(random, 4);
    const MassFunction third = random_mass(random, 4);
    EXPECT_LT(largest_difference(dempster(dempster(one, other), third),
                                 dempster(one, dempster(other, third))),
              1e-14);
    EXPECT_LT(largest_difference(yager(one, other), yager(other, one)), 1e-15);
    worst = std::max(worst, largest_difference(yager(yager(one, other), third),
                                               yager(one, yager(other, third))));
  }
  EXPECT_GT(worst, 0.01);
}

// Equations 4.1 and 4.3 are refinings: an element becomes a set, a union the union of the sets.
TEST(Refinement, KeepsMassesAndUnitesImages) {
  const std::array<Set, 2> images{0b0011, 0b0110};
  const MassFunction fine = refined(MassFunction(2, {{1, 0.5}, {2, 0.25}}), images, 4);
  EXPECT_EQ(fine[0b0011], 0.5);
  EXPECT_EQ(fine[0b0110], 0.25);
  EXPECT_EQ(fine[0b0111], 0.25);
  EXPECT_EQ(fine.total(), 1);
}

TEST(PignisticProbability, SharesASetAmongItsElements) {
  const MassFunction mass(3, {{kA, 0.25}, {kA | kB, 0.5}});
  EXPECT_NEAR(pignistic(mass, kA), 0.25 + 0.25 + 0.25 / 3, 1e-15);
  EXPECT_NEAR(pignistic(mass, kB), 0.25 + 0.25 / 3, 1e-15);
  EXPECT_NEAR(pignistic(mass, kC), 0.25 / 3, 1e-15);
  EXPECT_NEAR(pignistic(mass, kB | kC), pignistic(mass, kB) + pignistic(mass, kC), 1e-15);
  EXPECT_NEAR(pignistic(mass, mass.frame()), 1, 1e-15);
}

}  // namespace
}  // namespace iog::lab::reference::evidential
