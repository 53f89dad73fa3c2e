// Laws of set-associative caches, on a small one: two sets of two ways.
#include "lab/a9_model/cache.hpp"

#include <gtest/gtest.h>
#include <set>

namespace iog::a9_model {
namespace {

constexpr std::uint32_t kBytes = 4 * kLineBytes;

Cache small(Cache::Replacement replacement = Cache::Replacement::kLeastRecentlyUsed) {
  return {kBytes, 2, replacement};
}

TEST(Cache, HoldsWhatWasBroughtAndNothingElse) {
  Cache cache = small();
  EXPECT_EQ(cache.find(6), nullptr);
  EXPECT_FALSE(cache.allocate(6).evicted.valid);
  const Cache::Line* const line = cache.find(6);
  EXPECT_TRUE(line != nullptr && line->address == 6);
  EXPECT_EQ(cache.find(4), nullptr);
}

TEST(Cache, AOneWayCacheLosesALineToItsNeighbourInTheSameSet) {
  Cache cache(4 * kLineBytes, 1, Cache::Replacement::kLeastRecentlyUsed);
  cache.allocate(1);
  cache.allocate(2);
  EXPECT_NE(cache.find(1), nullptr);
  const Cache::Allocation conflict = cache.allocate(5);
  EXPECT_TRUE(conflict.evicted.valid);
  EXPECT_EQ(conflict.evicted.address, 1u);
  EXPECT_EQ(cache.find(1), nullptr);
  EXPECT_NE(cache.find(2), nullptr);
}

TEST(Cache, TheLeastRecentlyUsedLineGoes) {
  Cache cache = small();
  cache.allocate(0);
  cache.allocate(2);
  cache.find(0);
  EXPECT_EQ(cache.allocate(4).evicted.address, 2u);
  EXPECT_NE(cache.find(0), nullptr);
}

TEST(Cache, ADirtyLineIsDirtyWhenItIsEvicted) {
  Cache cache = small();
  cache.allocate(0).line->dirty = true;
  cache.allocate(2);
  cache.find(2);
  EXPECT_TRUE(cache.allocate(4).evicted.dirty);
  EXPECT_FALSE(cache.allocate(6).evicted.dirty);
}

TEST(Cache, RandomReplacementReachesEveryWayAndRepeats) {
  std::set<LineAddress> evicted;
  Cache first(16 * kLineBytes, 16, Cache::Replacement::kRandom);
  Cache second(16 * kLineBytes, 16, Cache::Replacement::kRandom);
  for (LineAddress line = 0; line < 16; ++line) {
    first.allocate(line);
    second.allocate(line);
  }
  for (LineAddress line = 16; line < 400; ++line) {
    const LineAddress gone = first.allocate(line).evicted.address;
    EXPECT_EQ(second.allocate(line).evicted.address, gone);
    evicted.insert(gone);
  }
  for (LineAddress line = 0; line < 16; ++line) {
    EXPECT_TRUE(evicted.contains(line)) << line;
  }
}

// 32 KB in four ways have 256 sets: five lines 8 KB apart do not fit, four do (the reason for grid
// rows that are not 1024 bytes).
TEST(Cache, FiveLinesEightKilobytesApartDoNotFitTheLevelOneCache) {
  Cache cache(32 * 1024, 4, Cache::Replacement::kLeastRecentlyUsed);
  for (LineAddress line = 0; line < 4; ++line) {
    EXPECT_FALSE(cache.allocate(line * 256).evicted.valid);
  }
  EXPECT_TRUE(cache.allocate(4 * 256).evicted.valid);
}

}  // namespace
}  // namespace iog::a9_model
