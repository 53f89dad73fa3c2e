// The cell that the integers of the core are compared with: by hand, and against the thesis's cell
// over all 64 sets wherever the two mean the same.
#include "fakes/reference_cell.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "fakes/reference_decision.hpp"
#include "lab/reference/evidential/perception.hpp"
#include "lab/reference/evidential/random_mass.hpp"

namespace iog::tests {
namespace {

namespace thesis = lab::reference::evidential;

constexpr std::array kDiscountings{Discounting::kConservative, Discounting::kOptimistic,
                                   Discounting::kClassical, Discounting::kProportional};

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

TEST(ReferenceFading, OfATenthOfASecond) {
  const ReferenceFading conservative = reference_fading(Discounting::kConservative, 100);
  EXPECT_NEAR(conservative.free, 0.9, 1e-15);
  EXPECT_NEAR(conservative.moving, 0.9, 1e-15);
  EXPECT_NEAR(conservative.occupied, 0.9 * 0.99, 1e-15);
  EXPECT_NEAR(conservative.standing, 0.99, 1e-15);
  EXPECT_NEAR(conservative.persistence, 0.99, 1e-15);
  EXPECT_EQ(reference_fading(Discounting::kOptimistic, 100).occupied, 1);
  EXPECT_NEAR(reference_fading(Discounting::kClassical, 100).standing, 0.9, 1e-15);
  EXPECT_NEAR(reference_fading(Discounting::kProportional, 100).occupied,
              std::sqrt(std::sqrt(0.9 * 0.99 * 0.99 * 0.99)), 1e-15);
}

// Equation 6.8: only age counts.
TEST(ReferenceFading, OfTwoTimesIsThatOfTheirSum) {
  for (const Discounting discounting : kDiscountings) {
    const ReferenceFading first = reference_fading(discounting, 37);
    const ReferenceFading second = reference_fading(discounting, 123);
    const ReferenceFading both = reference_fading(discounting, 160);
    EXPECT_NEAR(first.free * second.free, both.free, 1e-15);
    EXPECT_NEAR(first.occupied * second.occupied, both.occupied, 1e-15);
    EXPECT_NEAR(first.standing * second.standing, both.standing, 1e-15);
    EXPECT_NEAR(first.persistence * second.persistence, both.persistence, 1e-15);
  }
}

TEST(ReferenceFading, EndsAfterAMinute) {
  for (const Discounting discounting : kDiscountings) {
    EXPECT_GT(reference_fading(discounting, 65'535).standing, 0);
    const ReferenceFading late = reference_fading(discounting, 65'536);
    EXPECT_EQ(late.free + late.occupied + late.moving + late.standing + late.persistence, 0);
  }
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

TEST(ElapsedMs, AddsUpAndNeverRunsBack) {
  EXPECT_EQ(elapsed_ms(1999, 2000), 1U);
  EXPECT_EQ(elapsed_ms(2000, 2999), 0U);
  EXPECT_EQ(elapsed_ms(2000, 1999), 0U);
  std::uint64_t sum = 0;
  for (std::uint64_t frame = 0; frame < 1000; ++frame) {
    sum += elapsed_ms(frame * 40'333, (frame + 1) * 40'333);
  }
  EXPECT_EQ(sum, 40'333U);
}

TEST(ReferenceGains, AreThoseOfTheThesisAtItsRates) {
  EXPECT_NEAR(reference_gains(100).free_mass, 0.7, 1e-15);
  EXPECT_NEAR(reference_gains(1000.0 / 15).persistence, 1.0 / 45, 1e-15);  // equation 7.4
  EXPECT_NEAR(reference_gains(1000.0 / 15).decline, 6.0 / 45, 1e-15);
  EXPECT_NEAR(reference_gains(1000.0 / 15).specialisation, 1, 1e-12);
  EXPECT_NEAR(reference_gains(40).specialisation, 0.6, 1e-15);
}

TEST(ReferenceGains, StopAtOneAndAtAHundredMilliseconds) {
  EXPECT_EQ(reference_gains(0).free_mass, reference_gains(1).free_mass);
  EXPECT_EQ(reference_gains(5000).free_mass, reference_gains(100).free_mass);
  EXPECT_EQ(reference_gains(5000).decline, reference_gains(100).decline);
  EXPECT_EQ(reference_gains(5000).specialisation, 1);
}

// Four crossings within 100 ms say together what one scan of 10 Hz says.
TEST(ReferenceGains, OfFreeMassDoNotDependOnHowOftenOneLooks) {
  EXPECT_NEAR(std::pow(1 - reference_gains(25).free_mass, 4), 1 - reference_gains(100).free_mass,
              1e-15);
}

TEST(ReferenceEvidence, OfEveryRule) {
  const ReferenceGains gains = reference_gains(100);
  EXPECT_EQ(reference_evidence(2, gains, EvidenceRule::kByTime).occupied, 28'416.0 / 32'768);
  EXPECT_EQ(reference_evidence(127, gains, EvidenceRule::kByTime).occupied, 28'416.0 / 32'768);
  EXPECT_EQ(reference_evidence(-1, gains, EvidenceRule::kByTime).free, gains.free_mass);
  EXPECT_EQ(reference_evidence(2, gains, EvidenceRule::kThesis).occupied, 0.8);
  EXPECT_EQ(reference_evidence(-14, reference_gains(40), EvidenceRule::kThesis).free, 0.7);
  for (const auto rule : {EvidenceRule::kByTime, EvidenceRule::kReinforced,
                          EvidenceRule::kIsopignistic, EvidenceRule::kThesis}) {
    const ReferenceEvidence none = reference_evidence(0, gains, rule);
    EXPECT_EQ(none.free + none.occupied, 0);
  }
}

// In 128ths: 1 - 0.2^k is 0.8, 0.96, 0.992, 0.9984.
TEST(ReferenceEvidence, OfOneEchoAndMore) {
  const auto mass = [](int index) {
    return reference_evidence(index, reference_gains(100), EvidenceRule::kReinforced).occupied *
           128;
  };
  EXPECT_EQ(mass(1), 102);
  EXPECT_EQ(mass(2), 102);
  EXPECT_EQ(mass(3), 122);
  EXPECT_EQ(mass(4), 122);
  EXPECT_EQ(mass(6), 126);
  EXPECT_EQ(mass(8), 127);
  EXPECT_EQ(mass(127), 127);
}

// p_n of docs/model.md section 2, in 128ths, towards ignorance.
TEST(ReferenceEvidence, ThatIsIsopignistic) {
  const auto mass = [](int index) {
    const ReferenceEvidence evidence =
        reference_evidence(index, reference_gains(40), EvidenceRule::kIsopignistic);
    return (evidence.occupied - evidence.free) * 128;
  };
  EXPECT_EQ(mass(-127), -121);  // 0.95 at most
  EXPECT_EQ(mass(-14), -113);   // 1 - 2 * 0.056819 = 0.886362
  EXPECT_EQ(mass(-7), -77);     // 0.605856
  EXPECT_EQ(mass(-1), -12);     // 0.1
  EXPECT_EQ(mass(2), 25);       // 0.198020
  EXPECT_EQ(mass(6), 68);       // 0.538480
  EXPECT_EQ(mass(14), 113);
  EXPECT_EQ(mass(127), 121);
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

TEST(ReferenceCell, StaysAsItIsWithoutEvidence) {
  ReferenceCell cell = kSome;
  cell.fuse({}, true, kSomeGains);
  expect_near(cell, kSome);
}

TEST(ReferenceCell, AgesMassByMass) {
  ReferenceCell cell = kSome;
  cell.age({0.5, 0.25, 0.75, 0.125, 0.0625});
  expect_near(cell, {.free = 0.25,
                     .occupied = 0.05,
                     .moving = 0.075,
                     .standing = 0.0125,
                     .persistence = 0.03125});
}

// Why a hit is worth 111/128: on new ground it outlives one crossing at 25 Hz. 0.8 would not.
TEST(ReferenceCell, KeepsAHitForOneCrossedFrame) {
  const auto taken_after = [](double hit) {
    ReferenceCell cell;
    cell.fuse({.occupied = hit}, true, reference_gains(40));
    cell.age(reference_fading(Discounting::kConservative, 40));
    cell.fuse({.free = reference_gains(40).free_mass}, true, reference_gains(40));
    return cell.taken();
  };
  EXPECT_GT(taken_after(reference_evidence(2, reference_gains(40), EvidenceRule::kByTime).occupied),
            kHalf);
  EXPECT_LT(taken_after(0.8), kHalf);
}

TEST(ReferenceCell, OfAGroupIsInPartsOfCertainty) {
  evidence::Group group;
  group.free[3] = 32'767;
  group.persistence[3] = 16'384;
  group.moving[4] = 1;
  EXPECT_EQ(reference_cell(group, 3).free, 1);
  EXPECT_EQ(reference_cell(group, 3).persistence, kHalf);
  EXPECT_EQ(reference_cell(group, 4).moving, 1 / 32'767.0);
  EXPECT_EQ(reference_cell(group, 4).free, 0);
}

TEST(MassDifference, IsTheLargestAndKnowsIgnorance) {
  ReferenceCell other = kSome;
  EXPECT_EQ(mass_difference(kSome, other), 0);
  other.persistence = 0;
  EXPECT_EQ(mass_difference(kSome, other), 0);
  other.moving += 0.01;
  other.standing += 0.01;
  EXPECT_NEAR(mass_difference(kSome, other), 0.02, 1e-15);
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
double worst_difference(Discounting ours, thesis::Ageing theirs, Random& random) {
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
    const ReferenceEvidence evidence = reference_evidence(index, gains, EvidenceRule::kByTime);
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
  Random random(59);
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
}  // namespace iog::tests
