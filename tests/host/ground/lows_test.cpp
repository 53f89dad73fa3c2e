// Laws of the lowest returns: neither order, nor repetition, nor who collects them shows.
#include "ground/lows.hpp"

#include <gtest/gtest.h>
#include <map>
#include <utility>

#include "fakes/ground_turns.hpp"
#include "fakes/random.hpp"

namespace iog::ground {
namespace {

using tests::Random;
using tests::Return;
using tests::Turn;

constexpr Bins kBinsOf50m(50'000);

void add(Lows& lows, const Return& its) {
  lows.add(kBinsOf50m, static_cast<std::uint32_t>(its.sector),
           static_cast<std::uint32_t>(its.along_mm), its.z_mm);
}

Lows lows_of(const Turn& turn) {
  Lows lows;
  for (const Return& its : turn) {
    add(lows, its);
  }
  return lows;
}

TEST(Lows, AreTheLowestOfEachBin) {
  Random random(1);
  for (const Turn& turn : {tests::rough_turn(random, 1024), tests::any_turn(random, 20'000)}) {
    std::map<std::pair<int, int>, int> lowest;
    for (const Return& its : turn) {
      const int bin = its.along_mm / 1024;
      if (bin < 64 && its.z_mm >= -std::min(300 + 225 * (bin + 1), 14'000) && its.z_mm < 32'767) {
        int& low = lowest.try_emplace({bin, its.sector}, 32'767).first->second;
        low = std::min<int>(low, its.z_mm);
      }
    }
    const Lows lows = lows_of(turn);
    for (int bin = 0; bin < 64; ++bin) {
      for (int sector = 0; sector < 256; ++sector) {
        const auto found = lowest.find({bin, sector});
        const int low = lows.ring(static_cast<std::size_t>(bin))[static_cast<std::size_t>(sector)];
        ASSERT_EQ(low, found == lowest.end() ? 32'767 : found->second) << bin << ' ' << sector;
      }
    }
  }
}

TEST(Lows, DoNotMindOrderAndRepetition) {
  Random random(2);
  for (int i = 0; i < 5; ++i) {
    Turn turn = tests::rough_turn(random, 1024);
    const Turn more = tests::any_turn(random, 3000);
    turn.insert(turn.end(), more.begin(), more.end());
    const Lows before = lows_of(turn);
    for (int times = 0; times < 500; ++times) {
      turn.push_back(turn[random.below(turn.size())]);
    }
    for (std::size_t last = turn.size() - 1; last > 0; --last) {
      std::swap(turn[last], turn[random.below(last + 1)]);
    }
    EXPECT_EQ(lows_of(turn), before);
  }
}

// As cores collect them, whatever is whose.
TEST(Lows, OfPartsAreThoseOfAll) {
  Random random(3);
  const Turn turn = tests::rough_turn(random, 1024);
  for (const std::size_t cores : {2U, 3U, 4U}) {
    std::array<Lows, 4> parts;
    for (const Return& its : turn) {
      add(parts[random.below(cores)], its);
    }
    for (std::size_t other = 1; other < cores; ++other) {
      parts[0].join(parts[other]);
    }
    EXPECT_EQ(parts[0], lows_of(turn)) << cores;
  }
}

TEST(Lows, ForgetATurn) {
  Random random(4);
  Lows lows = lows_of(tests::rough_turn(random, 1024));
  EXPECT_NE(lows, Lows());
  lows.clear();
  EXPECT_EQ(lows, Lows());
}

}  // namespace
}  // namespace iog::ground
