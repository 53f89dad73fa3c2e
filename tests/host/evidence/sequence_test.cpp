// A cell through time: integers against real numbers, for as long as a drive lasts.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <utility>

#include "ageing/discounting.hpp"
#include "ageing/gains.hpp"
#include "decision/decision.hpp"
#include "evidence/cell.hpp"
#include "evidence/fusion.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/random_group.hpp"
#include "lab/reference/cell.hpp"
#include "lab/reference/cell_ageing.hpp"
#include "lab/reference/cell_decision.hpp"

namespace iog::evidence {
namespace {

using ageing::Discounting;
using lab::reference::ReferenceCell;

// What a value may be off, of 1, in a life as people lead it: something comes, stays and leaves.
constexpr double kUsualError = 0.0075;

// In the worst of two million random frames. The accumulator has a tie at P = 6 / 7, between
// growing and falling. Near it the rounding of P decides how fast it grows, and so when what is
// occupied becomes standing. What is free, what is taken and what is unknown hardly depend on it.
constexpr double kMassError = 0.01;
constexpr double kShareError = 0.04;
constexpr double kPersistenceError = 0.02;

// On the mean of a life.
constexpr double kMeanError = 0.0025;

lab::reference::ReferenceFading exactly_left(std::uint32_t ms, Discounting discounting) {
  switch (discounting) {
    case Discounting::kOptimistic:
      return reference_fading(lab::reference::Discounting::kOptimistic, ms);
    case Discounting::kClassical:
      return reference_fading(lab::reference::Discounting::kClassical, ms);
    case Discounting::kProportional:
      return reference_fading(lab::reference::Discounting::kProportional, ms);
    case Discounting::kConservative:
      break;
  }
  return reference_fading(lab::reference::Discounting::kConservative, ms);
}

void fuse_exactly(ReferenceCell& cell, int index, bool moved, std::uint32_t ms) {
  const lab::reference::ReferenceGains gains = lab::reference::reference_gains(ms);
  cell.fuse(reference_evidence(index, gains), moved, gains);
}

// The same cell twice: in cell 5 of a group, and exactly.
class Pair {
 public:
  explicit Pair(Discounting discounting) : discounting_(discounting) {}

  void age(std::uint32_t ms) {
    evidence::age(group_, ageing::left_after(ms, discounting_));
    exact_.age(exactly_left(ms, discounting_));
  }

  // index: its sign alone counts. ms: since the last evidence.
  void fuse(int index, bool moved, std::uint32_t ms) {
    Indexes indexes{};
    indexes[kCell] = static_cast<index::OccupancyIndex>(index);
    evidence::fuse(group_, Fading{}, indexes, moved ? 1U << kCell : 0,
                   ageing::gains_after(ms, ageing::kGainsByTime));
    fuse_exactly(exact_, index, moved, ms);
  }

  [[nodiscard]] Cell cell() const { return cell_of(group_, kCell); }
  [[nodiscard]] const ReferenceCell& exact() const { return exact_; }

  [[nodiscard]] double mass_error() const {
    const Cell found = cell();
    return std::max({off(found.free, exact_.free), off(found.taken(), exact_.taken()),
                     off(kCertain - found.free - found.taken(), exact_.ignorance())});
  }
  [[nodiscard]] double share_error() const {
    const Cell found = cell();
    return std::max({off(found.occupied, exact_.occupied), off(found.moving, exact_.moving),
                     off(found.standing, exact_.standing)});
  }
  [[nodiscard]] double persistence_error() const {
    return off(cell().persistence, exact_.persistence);
  }

  [[nodiscard]] int decided() {
    alignas(8) const decision::RuledOut nothing{};
    alignas(8) decision::Decided decided;
    decision::decide(group_, nothing, Indexes{}, decided);
    return decided[kCell] / 8;
  }

 private:
  static constexpr std::size_t kCell = 5;
  static double off(std::int32_t mass, double exact) {
    return std::abs(mass / double{kCertain} - exact);
  }

  Discounting discounting_;
  Group group_;
  ReferenceCell exact_;
};

// Free space, something that comes and stays, free again, and then nothing but time.
struct Phase {
  int frames;
  int index;
};
constexpr std::array kComesAndLeaves{Phase{10, -14}, Phase{15, 2}, Phase{5, -14}, Phase{5, 0}};

template <typename Check>
void for_each_frame(Pair& pair, bool moved, Check&& check) {
  constexpr std::uint32_t kFrameMs = 40;
  std::uint32_t since_evidence = 100;
  int frame = 0;
  for (const Phase& phase : kComesAndLeaves) {
    for (int i = 0; i < phase.frames; ++i) {
      if (frame++ > 0) {
        pair.age(kFrameMs);
      }
      pair.fuse(phase.index, moved, since_evidence);
      since_evidence = phase.index != 0 ? kFrameMs : since_evidence + kFrameMs;
      check(frame);
    }
  }
}

lab::reference::ReferenceDecision exactly_decided(const ReferenceCell& cell) {
  return reference_decision(cell, lab::reference::kMapSilent);
}

class WhatComesAndLeaves : public testing::TestWithParam<bool> {};

TEST_P(WhatComesAndLeaves, IsTheSameInIntegers) {
  Pair pair(Discounting::kConservative);
  for_each_frame(pair, GetParam(), [&](int frame) {
    ASSERT_LT(pair.mass_error(), kUsualError) << "frame " << frame;
    ASSERT_LT(pair.share_error(), kUsualError) << "frame " << frame;
    ASSERT_LT(pair.persistence_error(), kUsualError) << "frame " << frame;
  });
}

// On open ground (true) it moves for half a second, then it stands. Elsewhere two hits are not
// enough to tell. Either way one free frame leaves it occupied, and four make the cell free.
TEST_P(WhatComesAndLeaves, IsNamedAtEveryFrame) {
  constexpr std::array kLetters{'?', '-', '-', 'f', 'M', '-', 'S', '-', 'O'};
  Pair pair(Discounting::kConservative);
  std::string classes;
  std::string exact_classes;
  for_each_frame(pair, GetParam(), [&](int) {
    classes += kLetters[static_cast<std::size_t>(pair.decided())];
    exact_classes += kLetters[static_cast<std::size_t>(exactly_decided(pair.exact()).named)];
  });
  EXPECT_EQ(exact_classes, GetParam() ? "ffffffffff"
                                        "MMMMMMMMMMMMMOS"
                                        "O??ff"
                                        "fffff"
                                      : "ffffffffff"
                                        "OOSSSSSSSSSSSSS"
                                        "O??ff"
                                        "fffff");
  EXPECT_EQ(classes, exact_classes);
}
INSTANTIATE_TEST_SUITE_P(MovedOrNot, WhatComesAndLeaves, testing::Bool());

// One random life: phases in which beams cross, hit, do both or neither, at 10 to 25 frames a
// second.
void expect_a_life(Pair& pair, tests::Random& random, int frames) {
  const std::uint32_t period = static_cast<std::uint32_t>(random.between(40, 100));
  std::uint32_t since_evidence = 100;
  int hits_of_8 = 0;
  int beams_of_8 = 0;
  bool moved = false;
  double sum_of_errors = 0;
  for (int frame = 0; frame < frames; ++frame) {
    if (random.one_in(25)) {
      hits_of_8 = random.between(-4, 12);
      beams_of_8 = random.between(-4, 12);
      moved = random.one_in(2);
    }
    pair.age(period);
    const bool is_hit = random.between(0, 7) < hits_of_8;
    const bool is_crossed = random.between(0, 7) < beams_of_8;
    const int index = is_hit ? 2 : is_crossed ? -14 : 0;
    pair.fuse(index, moved, since_evidence + period);
    since_evidence = index != 0 ? 0 : since_evidence + period;
    sum_of_errors += std::max(pair.mass_error(), pair.share_error());
    ASSERT_LT(pair.mass_error(), kMassError) << "frame " << frame;
    ASSERT_LT(pair.share_error(), kShareError) << "frame " << frame;
    ASSERT_LT(pair.persistence_error(), kPersistenceError) << "frame " << frame;
    const lab::reference::ReferenceDecision exact = exactly_decided(pair.exact());
    if (exact.margin > 0.01) {
      ASSERT_EQ(pair.decided(), static_cast<int>(exact.named)) << "frame " << frame;
    }
  }
  ASSERT_LT(sum_of_errors / frames, kMeanError);
}

// One frame from any state, in units of 1 / 32767: a product loses less than two, one by rounding
// and one because 1 is 32767 of the 32768 parts that a product is divided by. A mass has at most
// two products, and what specialises has those of the accumulator as well.
TEST(OneFrame, IsOffByAFewUnits) {
  tests::Random random(21);
  for (int i = 0; i < tests::effort(20'000, 2000); ++i) {
    const Group before = tests::random_group(random);
    Group after = before;
    const auto ms = static_cast<std::uint32_t>(random.between(1, 100));
    const Gains gains = ageing::gains_after(ms, ageing::kGainsByTime);
    const int index = random.one_in(2) ? 2 : -14;
    const bool moved = random.one_in(2);
    Indexes indexes{};
    indexes.fill(static_cast<index::OccupancyIndex>(index));
    fuse(after, Fading{}, indexes, moved ? 0xFF : 0, gains);
    for (std::size_t j = 0; j < kGroupCells; ++j) {
      ReferenceCell exact = reference_cell(before, j);
      fuse_exactly(exact, index, moved, ms);
      const Cell found = cell_of(after, j);
      ASSERT_NEAR(found.free, exact.free * kCertain, 4);
      ASSERT_NEAR(found.occupied, exact.occupied * kCertain, 9);
      ASSERT_NEAR(found.moving, exact.moving * kCertain, 9);
      ASSERT_NEAR(found.standing, exact.standing * kCertain, 9);
      ASSERT_NEAR(found.persistence, exact.persistence * kCertain, 4);
    }
  }
}

class ALife : public testing::TestWithParam<std::pair<Discounting, const char*>> {};

TEST_P(ALife, IsTheSameInIntegers) {
  tests::Random random(20);
  for (int life = 0; life < tests::effort(200, 10); ++life) {
    Pair pair(GetParam().first);
    ASSERT_NO_FATAL_FAILURE(expect_a_life(pair, random, tests::effort(10'000, 2000)))
        << "life " << life;
  }
}
constexpr std::array kNamedDiscountings{std::pair{Discounting::kConservative, "Conservative"},
                                        std::pair{Discounting::kOptimistic, "Optimistic"},
                                        std::pair{Discounting::kClassical, "Classical"},
                                        std::pair{Discounting::kProportional, "Proportional"}};

INSTANTIATE_TEST_SUITE_P(By, ALife, testing::ValuesIn(kNamedDiscountings),
                         [](const auto& named) { return std::string(named.param.second); });

}  // namespace
}  // namespace iog::evidence
