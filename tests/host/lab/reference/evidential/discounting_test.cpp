// Tables 6.1 to 6.4 of the thesis in three readings: the digits as printed, what the printed
// equations give, and what is meant.
#include "lab/reference/evidential/discounting.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/random.hpp"
#include "lab/reference/evidential/random_mass.hpp"
#include "lab/reference/evidential/temporal_discounting.hpp"

namespace iog::lab::reference::evidential {
namespace {

using tests::largest_difference;
using tests::Random;
using tests::random_mass;
using tests::random_share;

// Subsets of a frame of three elements.
constexpr Set k1 = 1;
constexpr Set k2 = 2;
constexpr Set k3 = 4;
constexpr Set k12 = k1 | k2;
constexpr Set k13 = k1 | k3;
constexpr Set k23 = k2 | k3;
constexpr Set k123 = k1 | k2 | k3;

constexpr std::array kSchemes{Scheme::kOptimistic, Scheme::kProportional, Scheme::kConservative};

MassFunction even_mass() {
  MassFunction mass = MassFunction::empty(3);
  for (Set a = 0; a <= k123; ++a) {
    mass[a] = 1.0 / 8;
  }
  return mass;
}

// Of each singleton its own rate.
std::array<Rate, 3> by_element(const std::vector<double>& alphas) {
  return {Rate{k1, alphas[0]}, Rate{k2, alphas[1]}, Rate{k3, alphas[2]}};
}

// kappa after 4 s of section 6.6.1's cases 1 and 2: half-lives of 1, 4, 15 s and of 5, 4, 15 s.
std::vector<double> left_in_case(int number) {
  const std::array half_lives_s{number == 1 ? 1.0 : 5.0, 4.0, 15.0};
  return left_after(4, decay_rates(half_lives_s));
}

std::vector<double> lost_of(std::vector<double> left) {
  for (double& share : left) {
    share = 1 - share;
  }
  return left;
}

// The mass function of tables 6.3 and 6.4.
MassFunction of_table_6_3() {
  return MassFunction(3, {{k1, 0.3}, {k2, 0.2}, {k12, 0.2}, {k3, 0.2}});
}

// One scheme's masses of {1}, {2}, {1, 2}, {3} and the frame: a column of a table.
using Column = std::array<double, 5>;

Column column(const MassFunction& mass) {
  return {mass[k1], mass[k2], mass[k12], mass[k3], mass[k123]};
}

void expect_columns(const std::vector<double>& alphas, const std::array<Column, 3>& expected,
                    double tolerance) {
  for (std::size_t scheme = 0; scheme < kSchemes.size(); ++scheme) {
    const Column actual = column(discounted(of_table_6_3(), kSchemes[scheme], by_element(alphas)));
    for (std::size_t row = 0; row < actual.size(); ++row) {
      EXPECT_NEAR(actual[row], expected[scheme][row], tolerance)
          << "scheme " << scheme << ", row " << row;
    }
  }
}

// Table 6.1: what is left of each set, in the words of the table.
TEST(Table61, IsWhatIsMeant) {
  Random random(61);
  for (int round = 0; round < 20; ++round) {
    const double alpha_1 = random_share(random);
    const double alpha_23 = random_share(random);
    const std::array rates{Rate{k1, alpha_1}, Rate{k23, alpha_23}};
    const double b1 = 1 - alpha_1;
    const double b23 = 1 - alpha_23;
    const double halves = (1 - alpha_1 / 2) * (1 - alpha_23 / 2);
    //                                        {}      1   2    12      3    13      23
    const std::array<std::array<double, 7>, 3> left{
        {{b1 * b23, b1, b23, 1, b23, 1, b23},
         {b1 * b23, b1, b23, halves, b23, halves, b23},
         {b1 * b23, b1, b23, b1 * b23, b23, b1 * b23, b23}}};
    for (std::size_t scheme = 0; scheme < kSchemes.size(); ++scheme) {
      const MassFunction mass = discounted(even_mass(), kSchemes[scheme], rates);
      for (Set a = 0; a < k123; ++a) {
        ASSERT_NEAR(mass[a], left[scheme][a] / 8, 1e-15) << "scheme " << scheme << ", set " << a;
      }
      ASSERT_NEAR(mass.total(), 1, 1e-15);
    }
  }
}

TEST(Table61, AtThreeAndTwoTenths) {
  const std::array rates{Rate{k1, 0.3}, Rate{k23, 0.2}};
  const std::array of_12{0.125, 0.095625, 0.07};
  const std::array of_frame{0.2925, 0.35125, 0.4025};
  for (std::size_t scheme = 0; scheme < kSchemes.size(); ++scheme) {
    const MassFunction mass = discounted(even_mass(), kSchemes[scheme], rates);
    EXPECT_NEAR(mass[k12], of_12[scheme], 1e-15);
    EXPECT_NEAR(mass[k123], of_frame[scheme], 1e-15);
  }
}

// Equation 6.30 multiplies by |A n theta| / |A| what table 6.1 takes that share from: at rates of 0
// mass is lost all the same.
TEST(PrintedEquations, ContradictTable61InTheProportionalScheme) {
  const std::array rates{Rate{k1, 0.3}, Rate{k23, 0.2}};
  const MassFunction printed = discounted_as_printed(even_mass(), Scheme::kProportional, rates);
  EXPECT_NEAR(printed[k12], 0.0175, 1e-15);  // 0.7 / 2 * 0.8 / 2 of an eighth
  const std::array none{Rate{k1, 0}, Rate{k23, 0}};
  EXPECT_NEAR(discounted_as_printed(even_mass(), Scheme::kProportional, none)[k12], 1.0 / 32,
              1e-15);
  EXPECT_EQ(discounted(even_mass(), Scheme::kProportional, none)[k12], 1.0 / 8);
}

// Equations 6.20, 6.21, 6.23, 6.24 and 6.29 are right; 6.22 and 6.25 multiply what is lost where a
// set loses 1 less the product of what is left.
TEST(PrintedEquations, AreRightButForTheFrame) {
  const std::array rates{Rate{k1, 0.3}, Rate{k23, 0.2}};
  for (const Scheme scheme : {Scheme::kConservative, Scheme::kOptimistic}) {
    const MassFunction printed = discounted_as_printed(even_mass(), scheme, rates);
    const MassFunction meant = discounted(even_mass(), scheme, rates);
    for (Set a = 0; a < k123; ++a) {
      EXPECT_NEAR(printed[a], meant[a], 1e-15);
    }
    EXPECT_GT(std::abs(printed.total() - 1), 0.1);
  }
  EXPECT_NEAR(discounted_as_printed(even_mass(), Scheme::kConservative, rates).total(), 0.8025,
              1e-15);
}

// Table 6.2, an aerial target. Its optimistic column prints 0.5 for the rocket and nothing for the
// frame, but {r} is a part of {h, r}.
TEST(Table62, IsTheSameForAllSchemes) {
  const MassFunction report(3, {{k1, 0.5}, {k3, 0.5}});  // aeroplane, rocket
  const std::array rates{Rate{k23, 0.4}};
  for (const Scheme scheme : kSchemes) {
    const MassFunction mass = discounted(report, scheme, rates);
    EXPECT_NEAR(mass[k1], 0.5, 1e-15);
    EXPECT_NEAR(mass[k3], 0.3, 1e-15);
    EXPECT_NEAR(mass[k123], 0.2, 1e-15);
  }
}

// Equation 6.41: for a similar result Mercier's rate stands at the complement.
TEST(ContextualDiscounting, HitsTheComplement) {
  const MassFunction report(3, {{k1, 0.5}, {k3, 0.5}});
  const MassFunction mass = discounted_contextually(report, std::array{Rate{k1, 0.4}});
  EXPECT_NEAR(mass[k1], 0.5, 1e-15);
  EXPECT_NEAR(mass[k3], 0.3, 1e-15);
  EXPECT_NEAR(mass[k13], 0.2, 1e-15);
}

// What is left was taken for what is lost (equations 6.68 and 6.69): class 1, of which after four
// half-lives a sixteenth should be left, keeps 94 %.
TEST(Table63, AsPrintedLosesWhatShouldBeLeft) {
  const std::array<Column, 3> printed{{{0.281, 0.1, 0.2, 0.034, 0.385},
                                       {0.281, 0.1, 0.1453125, 0.034, 0.440},
                                       {0.281, 0.1, 0.09375, 0.034, 0.491}}};
  expect_columns(left_in_case(1), printed, 5e-4);
  const std::array<Column, 3> exactly{{{0.281250, 0.1, 0.2, 0.033752, 0.384998},
                                       {0.281250, 0.1, 0.145313, 0.033752, 0.439685},
                                       {0.281250, 0.1, 0.093750, 0.033752, 0.491248}}};
  expect_columns(left_in_case(1), exactly, 1e-6);
}

TEST(Table63, AsMeant) {
  const std::array<Column, 3> meant{{{0.018750, 0.1, 0.2, 0.166248, 0.515002},
                                     {0.018750, 0.1, 0.079688, 0.166248, 0.635315},
                                     {0.018750, 0.1, 0.006250, 0.166248, 0.708752}}};
  expect_columns(lost_of(left_in_case(1)), meant, 1e-6);
}

// To its printed digits, table 6.4 comes out only of kappa rounded to four digits.
TEST(Table64, AsPrintedLosesWhatShouldBeLeft) {
  const std::array<Column, 3> printed{{{0.12771, 0.1, 0.2, 0.03376, 0.53853},
                                       {0.12771, 0.1, 0.1069275, 0.03376, 0.6316025},
                                       {0.12771, 0.1, 0.04257, 0.03376, 0.69596}}};
  expect_columns({0.5743, 0.5, 0.8312}, printed, 5e-6);
  const std::array<Column, 3> exactly{{{0.127695, 0.1, 0.2, 0.033752, 0.538552},
                                       {0.127695, 0.1, 0.106924, 0.033752, 0.631629},
                                       {0.127695, 0.1, 0.042565, 0.033752, 0.695987}}};
  expect_columns(left_in_case(2), exactly, 1e-6);
}

TEST(Table64, AsMeant) {
  const std::array<Column, 3> meant{{{0.172305, 0.1, 0.2, 0.166248, 0.361448},
                                     {0.172305, 0.1, 0.118076, 0.166248, 0.443371},
                                     {0.172305, 0.1, 0.057435, 0.166248, 0.504013}}};
  expect_columns(lost_of(left_in_case(2)), meant, 1e-6);
}

// Neither table is what equations 6.30 and 6.31 give, whichever of the two is taken for alpha.
TEST(Tables63And64, AreNotThePrintedProportionalEquations) {
  for (const int number : {1, 2}) {
    for (const auto& alphas : {left_in_case(number), lost_of(left_in_case(number))}) {
      const MassFunction mass =
          discounted_as_printed(of_table_6_3(), Scheme::kProportional, by_element(alphas));
      EXPECT_LT(mass[k12], 0.05);  // at most a quarter of 0.2
      EXPECT_GT(std::abs(mass.total() - 1), 0.05);
    }
  }
}

// Mercier's column is right, so that it cannot be compared with the others.
TEST(Table64, IsRightForContextualDiscounting) {
  const std::vector<double> alphas = contextual_rates(left_in_case(2));
  const MassFunction mass = discounted_contextually(of_table_6_3(), by_element(alphas));
  const std::array printed{0.0, 0.1723, 0.1, 0.1391, 0.1662, 0.15, 0.074, 0.1983};
  const std::array exactly{0.0, 0.172305, 0.1, 0.139137, 0.166248, 0.150028, 0.074019, 0.198264};
  for (Set a = 0; a <= k123; ++a) {
    EXPECT_NEAR(mass[a], printed[a], 5e-5) << "set " << a;
    EXPECT_NEAR(mass[a], exactly[a], 1e-6) << "set " << a;
  }
}

// Section 6.6.1, case C2: m_Theta, by equations 6.12 and 6.14 as by 6.42.
TEST(ContextualMass, IsThatOfCase2) {
  const std::array rates = by_element(contextual_rates(left_in_case(2)));
  const MassFunction mass = contextual_mass(3, rates);
  const std::array printed{0.4886, 0.0858, 0.0114, 0.0020, 0.3427, 0.0602, 0.0080, 0.0014};
  for (Set a = 0; a <= k123; ++a) {
    double product = 1;
    for (const Rate& rate : rates) {
      product *= is_subset(rate.theta, a) ? rate.alpha : 1 - rate.alpha;
    }
    EXPECT_NEAR(mass[a], product, 1e-15) << "set " << a;
    EXPECT_NEAR(mass[a], printed[a], 5e-5) << "set " << a;
  }
}

// The example of section 6.6.1 after 4 s, and that of 6.6.2 after 60 s, whose equation 6.64 was
// left empty.
TEST(ContextualDiscounting, GivesTheExamplesOfSection66) {
  const MassFunction mass(3, {{k1, 0.3}, {k2, 0.4}, {k3, 0.2}});
  const MassFunction soon =
      discounted_contextually(mass, by_element(contextual_rates(left_in_case(2))));
  const std::array after_4_s{0.0, 0.1723, 0.2, 0.0391, 0.1662, 0.15, 0.1442, 0.1281};
  for (Set a = 0; a <= k123; ++a) {
    EXPECT_NEAR(soon[a], after_4_s[a], 5.1e-5) << "set " << a;
  }
  const std::vector<double> left = left_after(60, decay_rates(std::array{5.0, 4.0, 15.0}));
  const MassFunction late = discounted_contextually(mass, by_element(contextual_rates(left)));
  const std::array after_60_s{0.0,       0.0000732, 0.0000122, 0.0001562,
                              0.0125000, 0.3409801, 0.0405208, 0.6057574};
  for (Set a = 0; a <= k123; ++a) {
    EXPECT_NEAR(late[a], after_60_s[a], 1e-7) << "set " << a;
  }
}

// Section 6.4.1.
TEST(Discounting, WithTheFrameAloneIsClassical) {
  Random random(64);
  const MassFunction mass = random_mass(random, 4);
  const MassFunction classical = discounted_classically(mass, 0.3);
  for (const Scheme scheme : kSchemes) {
    const MassFunction same = discounted(mass, scheme, std::array{Rate{mass.frame(), 0.3}});
    EXPECT_LT(largest_difference(same, classical), 1e-15);
  }
}

// Equations 6.32 and 6.33, and 6.38.
TEST(Discounting, KnowsNoOrderAndIsOrdered) {
  Random random(632);
  for (int round = 0; round < 50; ++round) {
    const MassFunction mass = random_mass(random, 5);
    const Rate one{static_cast<Set>(random.between(1, 30)), random_share(random)};
    const Rate other{static_cast<Set>(random.between(1, 30)), random_share(random)};
    std::vector<MassFunction> together;
    for (const Scheme scheme : kSchemes) {
      together.push_back(discounted(mass, scheme, std::array{one, other}));
      const MassFunction first = discounted(mass, scheme, std::array{one});
      const MassFunction second = discounted(mass, scheme, std::array{other});
      EXPECT_LT(largest_difference(discounted(first, scheme, std::array{other}), together.back()),
                1e-15);
      EXPECT_LT(largest_difference(discounted(second, scheme, std::array{one}), together.back()),
                1e-15);
    }
    for (Set a = 0; a < mass.frame(); ++a) {
      EXPECT_GE(together[0][a], together[1][a]);
      EXPECT_GE(together[1][a], together[2][a]);
    }
  }
}

}  // namespace
}  // namespace iog::lab::reference::evidential
