// The cell that the integers of the core are compared with: it is the thesis's cell over all 64
// sets wherever the two mean the same.
#include "lab/reference/cell.hpp"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "lab/reference/evidential/perception.hpp"

namespace iog::lab::reference {
namespace {

namespace thesis = evidential;

constexpr ReferenceCell kSome{
    .free = 0.5, .occupied = 0.2, .moving = 0.1, .standing = 0.1, .persistence = 0.5};
constexpr ReferenceGains kSomeGains{
    .free_mass = 0.7, .persistence = 0.1, .decline = 0.6, .specialisation = 0.5};

void expect_near(const ReferenceCell& cell, const ReferenceCell& expected) {
  EXPECT_NEAR(cell.free, expected.free, 1e-15);
  EXPECT_NEAR(cell.occupied, expected.occupied, 1e-15);
  EXPECT_NEAR(cell.moving, expected.moving, 1e-15);
  EXPECT_NEAR(cell.standing, expected.standing, 1e-15);
  EXPECT_NEAR(cell.persistence, expected.persistence, 1e-15);
}

// The scheme of the thesis depends on how often one looks, against its own equation 6.8; in smaller
// and smaller steps it comes to what is used here.
TEST(ReferenceFading, IsTheProportionalSchemeInSmallSteps) {
  const auto left_of_occupied = [](int steps) {
    thesis::MassFunction mass(thesis::kPerceptionElements, {{thesis::kOccupied, 1}});
    const thesis::ScanParameters step{.ageing = thesis::Ageing::kProportional,
                                      .dynamic_loss = 1 - std::pow(0.9, 5.0 / steps),
                                      .static_loss = 1 - std::pow(0.99, 5.0 / steps)};
    for (int i = 0; i < steps; ++i) {
      mass = thesis::aged(mass, step);
    }
    return mass[thesis::kOccupied];
  };
  const double limit = reference_fading(Discounting::kProportional, 500).occupied;
  EXPECT_GT(left_of_occupied(1), limit + 0.02);
  EXPECT_LT(left_of_occupied(10), left_of_occupied(1) - 0.015);
  EXPECT_NEAR(left_of_occupied(5000), limit, 5e-6);
}

// F 0.5 hit by 0.8: conflict 0.4. Of the 0.1 of ignorance 0.08 becomes occupied. P' = 0.88, zeta
// = 0.5 + 0.88 * 0.6 * 0.1 - 0.12 * 0.6 = 0.4808, s = 0.2404.
TEST(ReferenceCell, HitWhereItWasFreeByHand) {
  ReferenceCell moved = kSome;
  moved.fuse({.occupied = 0.8}, true, kSomeGains);
  expect_near(moved, {.free = 0.1,
                      .occupied = 0.28 - 0.28 * 0.2404,
                      .moving = 0.5 - 0.5 * 0.2404,
                      .standing = 0.1 + 0.28 * 0.2404,
                      .persistence = 0.4808});
  ReferenceCell flickered = kSome;
  flickered.fuse({.occupied = 0.8}, false, kSomeGains);
  expect_near(flickered, {.free = 0.1,
                          .occupied = 0.68 - 0.68 * 0.2404,
                          .moving = 0.1 - 0.1 * 0.2404,
                          .standing = 0.1 + 0.68 * 0.2404,
                          .persistence = 0.4808});
}

// P 0.4 crossed by 0.7: conflict 0.28, ignorance's. Of the 0.1 of ignorance 0.07 becomes free.
// P' = 0.12, and zeta would be 0.5 + 0.12 * 0.72 * 0.1 - 0.88 * 0.6 < 0.
TEST(ReferenceCell, CrossedWhereItWasOccupiedByHand) {
  ReferenceCell cell = kSome;
  cell.fuse({.free = 0.7}, true, kSomeGains);
  expect_near(cell, {.free = 0.57, .occupied = 0.06, .moving = 0.03, .standing = 0.03});
  EXPECT_NEAR(cell.ignorance(), 0.31, 1e-15);
}

// The largest difference between the masses of two cells, ignorance included.
double mass_difference(const ReferenceCell& one, const ReferenceCell& other) {
  const std::array differences{one.free - other.free, one.occupied - other.occupied,
                               one.moving - other.moving, one.standing - other.standing,
                               one.ignorance() - other.ignorance()};
  double largest = 0;
  for (const double difference : differences) {
    largest = std::max(largest, std::abs(difference));
  }
  return largest;
}

// The thesis's cell without a map: F, O, M, K are its masses of {D, N}, {I, M, S, U}, {M} and
// {I, S, U}, all else is ignorance. Accumulators fade here and not there, and what is proportional
// is taken step by step there: both are given to our cell for the comparison.
ReferenceFading as_printed(ReferenceFading left, const thesis::ScanParameters& scan) {
  left.persistence = 1;
  if (scan.ageing == thesis::Ageing::kProportional) {
    left.occupied = (1 - scan.dynamic_loss / 4) * (1 - scan.static_loss * 3 / 4);
  }
  return left;
}

ReferenceCell sensor_part(const thesis::PerceptionCell& cell) {
  return {.free = cell.mass[thesis::kFree],
          .occupied = cell.mass[thesis::kOccupied],
          .moving = cell.mass[thesis::kMoving],
          .standing = cell.mass[thesis::kStanding],
          .persistence = cell.accumulator};
}

// Frames of phases that are free, occupied, unseen or mixed, 1 to 300 ms apart. Returns how far the
// two cells come apart.
double worst_difference(Discounting ours, thesis::Ageing theirs, tests::Random& random) {
  ReferenceCell cell;
  thesis::PerceptionCell reference;
  double worst = 0;
  for (int frame = 0, phase = 0; frame < 500; ++frame) {
    phase = random.one_in(15) ? random.between(0, 3) : phase;
    const double ms = random.between(1, 300);
    const ReferenceGains gains = reference_gains(ms);
    const thesis::ScanParameters scan{.ageing = theirs,
                                      .dynamic_loss = 1 - std::pow(0.9, ms / 100),
                                      .static_loss = 1 - std::pow(0.99, ms / 100),
                                      .gain = gains.persistence,
                                      .decline = 6,
                                      .specialised_share = gains.specialisation,
                                      .which = thesis::Specialised::kOccupiedSets};
    const int index = phase == 3 ? random.between(-1, 1) : 1 - phase;  // 0: unseen
    const ReferenceEvidence evidence = reference_evidence(index, gains);
    cell.age(as_printed(reference_fading(ours, ms), scan));
    cell.fuse(evidence, true, gains);
    if (index == 0) {
      reference.pass(scan);
    } else {
      reference.scan(thesis::source_evidence(evidence.free, evidence.occupied), scan);
    }
    const ReferenceCell theirs_now = sensor_part(reference);
    worst = std::max({worst, mass_difference(cell, theirs_now),
                      std::abs(cell.persistence - theirs_now.persistence)});
  }
  return worst;
}

TEST(ReferenceCell, IsThatOfTheThesisWhereEveryAppearanceMoves) {
  tests::Random random(59);
  for (int round = 0; round < 20; ++round) {
    EXPECT_LT(worst_difference(Discounting::kConservative, thesis::Ageing::kConservative, random),
              1e-12);
    EXPECT_LT(worst_difference(Discounting::kOptimistic, thesis::Ageing::kOptimistic, random),
              1e-12);
    EXPECT_LT(worst_difference(Discounting::kClassical, thesis::Ageing::kClassical, random), 1e-12);
    EXPECT_LT(worst_difference(Discounting::kProportional, thesis::Ageing::kProportional, random),
              1e-12);
  }
}

}  // namespace
}  // namespace iog::lab::reference
