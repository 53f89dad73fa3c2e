// Runs of things: all of them, in order, and shorter to the end.
#include "work/runs.hpp"

#include <gtest/gtest.h>
#include <numeric>
#include <vector>

namespace iog::work {
namespace {

constexpr std::array<Runs::Lengths, 5> kLengths{{{},
                                                 {.shortest = 4, .longest = 32},
                                                 {.shortest = 1, .longest = 6},
                                                 {.shortest = 8, .longest = 8},
                                                 {.shortest = 5}}};

std::vector<std::size_t> lengths_of(const Runs& runs) {
  std::vector<std::size_t> lengths;
  for (std::size_t item = 0; item < runs.count(); ++item) {
    lengths.push_back(runs[item].end - runs[item].first);
  }
  return lengths;
}

TEST(Runs, HoldEachThingOnce) {
  for (const Runs::Lengths& lengths : kLengths) {
    for (std::size_t things = 0; things <= Round::kMaxItems; ++things) {
      const Runs runs(things, lengths);
      std::size_t next = 0;
      for (std::size_t item = 0; item < runs.count(); ++item) {
        ASSERT_EQ(runs[item].first, next);
        ASSERT_GT(runs[item].end, next);
        next = runs[item].end;
      }
      ASSERT_EQ(next, things);
    }
  }
}

TEST(Runs, AreNoLongerThanAllowedOrThanTheOneBefore) {
  for (const Runs::Lengths& allowed : kLengths) {
    for (std::size_t things = 1; things <= Round::kMaxItems; ++things) {
      const std::vector<std::size_t> lengths = lengths_of(Runs(things, allowed));
      ASSERT_TRUE(std::ranges::is_sorted(lengths, std::ranges::greater()));
      ASSERT_LE(lengths.front(), std::max(allowed.longest, allowed.shortest));
      ASSERT_TRUE(std::all_of(lengths.begin(), lengths.end() - 1, [&allowed](std::size_t length) {
        return length >= allowed.shortest;
      }));
    }
  }
}

// Half of the share that each of four cores has of what is left.
TEST(Runs, TakeAnEighthOfWhatIsLeft) {
  EXPECT_EQ(lengths_of(Runs(64, {.shortest = 3, .longest = 7})),
            (std::vector<std::size_t>{7, 7, 6, 5, 4, 4, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 1}));
}

// Each item goes to whichever core is idle first. Work of one kind is a hundred times that of
// another and comes in stretches, as tiles ahead of a vehicle do.
TEST(Runs, OfUnequalThingsKeepFourCoresEquallyBusy) {
  constexpr std::size_t kThings = 480;
  constexpr Runs::Lengths kRun{.shortest = 2, .longest = 6};
  for (std::size_t shift = 0; shift < kThings; ++shift) {
    const Runs runs(kThings, kRun);
    std::array<std::size_t, 4> busy{};
    for (std::size_t item = 0; item < runs.count(); ++item) {
      std::size_t& idle = *std::ranges::min_element(busy);
      for (std::size_t thing = runs[item].first; thing < runs[item].end; ++thing) {
        idle += (thing + shift) % kThings < kThings / 4 ? 100 : 1;
      }
    }
    const std::size_t all = std::accumulate(busy.begin(), busy.end(), std::size_t{0});
    ASSERT_LT(100 * std::ranges::max(busy) * busy.size(), 115 * all) << shift;
  }
}

TEST(Runs, AreFewerThanThings) { EXPECT_LE(Runs(Round::kMaxItems, {}).count(), 64U); }

}  // namespace
}  // namespace iog::work
