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
#include "fakes/exact_cell.hpp"
#include "fakes/random.hpp"
#include "fakes/random_group.hpp"

namespace iog::evidence {
namespace {

using ageing::Discounting;
using tests::ExactCell;

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

double exact_occupied(Discounting discounting, double ms) {
  const double dynamic = tests::exact_dynamic(ms);
  const double fixed = tests::exact_static(ms);
  switch (discounting) {
    case Discounting::kOptimistic:
      return 1;
    case Discounting::kClassical:
      return dynamic;
    case Discounting::kProportional:
      return std::pow(dynamic, 0.25) * std::pow(fixed, 0.75);
    case Discounting::kConservative:
      break;
  }
  return dynamic * fixed;
}

// The same cell twice: in cell 5 of a group, and exactly.
class Pair {
 public:
  explicit Pair(Discounting discounting) : discounting_(discounting) {}

  void age(std::uint32_t ms) {
    evidence::age(group_, ageing::left_after(ms, discounting_));
    const double fixed = discounting_ == Discounting::kClassical ? tests::exact_dynamic(ms)
                                                                 : tests::exact_static(ms);
    age_exactly(exact_, tests::exact_dynamic(ms), exact_occupied(discounting_, ms), fixed);
  }

  // index: its sign alone counts. ms: since the last evidence.
  void fuse(int index, bool moved, std::uint32_t ms) {
    Indexes indexes{};
    indexes[kCell] = static_cast<index::OccupancyIndex>(index);
    evidence::fuse(group_, indexes, moved ? 1U << kCell : 0,
                   ageing::gains_after(ms, ageing::Weighing::kByTime));
    if (index != 0) {
      const std::uint32_t weighed = std::clamp<std::uint32_t>(ms, 1, 100);
      fuse_exactly(exact_, index > 0 ? 111.0 / 128 : 0,
                   index < 0 ? tests::exact_free_mass(weighed) : 0, moved, weighed);
    }
  }

  [[nodiscard]] Cell cell() const { return cell_of(group_, kCell); }
  [[nodiscard]] const ExactCell& exact() const { return exact_; }

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
    decision::decide(group_, Indexes{});
    return group_.decided[kCell] / 8;
  }

 private:
  static constexpr std::size_t kCell = 5;
  static double off(std::int32_t mass, double exact) {
    return std::abs(mass / double{kCertain} - exact);
  }

  Discounting discounting_;
  Group group_;
  ExactCell exact_;
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

// Where a decision differs from the exact one, the exact one is close to a tie.
double distance_from_a_tie(const ExactCell& cell) {
  const double moving = cell.moving + cell.occupied / 2;
  return std::min({std::abs(cell.free - 0.5), std::abs(cell.taken() - 0.5), std::abs(moving - 0.5),
                   std::abs(cell.taken() - moving - 0.5)});
}

// Class of a cell where the map is silent.
int exact_decision(const ExactCell& cell) {
  const double moving = cell.moving + cell.occupied / 2;
  if (cell.free >= 0.5) {
    return 3;
  }
  if (cell.taken() < 0.5) {
    return 0;
  }
  if (moving >= 0.5) {
    return 4;
  }
  return cell.taken() - moving >= 0.5 ? 6 : 8;
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
    exact_classes += kLetters[static_cast<std::size_t>(exact_decision(pair.exact()))];
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
    if (distance_from_a_tie(pair.exact()) > 0.01) {
      ASSERT_EQ(pair.decided(), exact_decision(pair.exact())) << "frame " << frame;
    }
  }
  ASSERT_LT(sum_of_errors / frames, kMeanError);
}

// One frame from any state: every product loses less than one unit of 2^-15, and 1 is 32767 of them
// where the exact cell has 32768. A value has at most four products, and what specialises has five
// more units from the accumulator.
TEST(OneFrame, IsOffByAFewUnits) {
  constexpr double kUnit = 1.0 / 32'768;
  tests::Random random(21);
  for (int i = 0; i < tests::effort(20'000, 2000); ++i) {
    const Group before = tests::random_group(random);
    Group after = before;
    const auto ms = static_cast<std::uint32_t>(random.between(1, 100));
    const Gains gains = ageing::gains_after(ms, ageing::Weighing::kByTime);
    const int index = random.one_in(2) ? 2 : -14;
    const bool moved = random.one_in(2);
    Indexes indexes{};
    indexes.fill(static_cast<index::OccupancyIndex>(index));
    fuse(after, indexes, moved ? 0xFF : 0, gains);
    for (std::size_t j = 0; j < kGroupCells; ++j) {
      const Cell cell = cell_of(before, j);
      ExactCell exact{cell.free * kUnit, cell.occupied * kUnit, cell.moving * kUnit,
                      cell.standing * kUnit, cell.persistence * kUnit};
      fuse_exactly(exact, index > 0 ? 111.0 / 128 : 0, index < 0 ? tests::exact_free_mass(ms) : 0,
                   moved, ms);
      const Cell found = cell_of(after, j);
      ASSERT_NEAR(found.free, exact.free / kUnit, 4);
      ASSERT_NEAR(found.occupied, exact.occupied / kUnit, 9);
      ASSERT_NEAR(found.moving, exact.moving / kUnit, 9);
      ASSERT_NEAR(found.standing, exact.standing / kUnit, 9);
      ASSERT_NEAR(found.persistence, exact.persistence / kUnit, 4);
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
