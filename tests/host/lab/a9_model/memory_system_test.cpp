// Times of loads and stores in L1, L2 and memory, by the constants that were put in.
#include "lab/a9_model/memory_system.hpp"

#include <gtest/gtest.h>

namespace iog::a9_model {
namespace {

constexpr std::uint32_t kData = 0x1010'0000;

Constants quiet() {
  Constants constants = constants_of(Variant::kNominal);
  constants.random_replacement = 0;
  constants.prefetch_lines = 0;
  constants.main_tlb_extra = 0;
  constants.walk_extra = 0;
  return constants;
}

TEST(MemorySystem, TheFirstLoadWaitsForMemoryTheSecondForNothing) {
  MemorySystem memory(quiet());
  EXPECT_EQ(memory.load(kData, 1000), 1000u + 19 + 110);
  EXPECT_EQ(memory.load(kData + 28, 1010), 1129u);  // the same line, still on its way
  EXPECT_EQ(memory.load(kData, 2000), 2000u);
  EXPECT_EQ(memory.counts().data_refills, 1u);
  EXPECT_EQ(memory.counts().ddr_reads, 1u);
}

// 64 KB do not fit L1, but L2: the second pass costs its latency, not that of memory.
TEST(MemorySystem, WhatLeftLevelOneIsInLevelTwo) {
  MemorySystem memory(quiet());
  Cycle now = 0;
  for (int pass = 0; pass < 2; ++pass) {
    for (std::uint32_t offset = 0; offset < 64 * 1024; offset += kLineBytes) {
      const Cycle ready = memory.load(kData + offset, now);
      EXPECT_EQ(ready - now, pass == 0 ? 129u : 19u);
      now = ready + 100;
    }
  }
  EXPECT_EQ(memory.counts().l2_misses, 2048u);
}

TEST(MemorySystem, TwoFillBuffersServeTwoMissesAtATime) {
  MemorySystem memory(quiet());
  const Cycle first = memory.load(kData, 0);
  const Cycle second = memory.load(kData + 4096, 0);
  const Cycle third = memory.load(kData + 8192, 0);
  EXPECT_LT(second, first + 30);
  EXPECT_GE(third, first + 129);
}

// Every miss to the next line finds it asked for already.
TEST(MemorySystem, AStreamIsPrefetched) {
  Constants constants = quiet();
  constants.prefetch_lines = 2;
  MemorySystem memory(constants);
  Cycle now = 0;
  for (std::uint32_t line = 0; line < 1000; ++line) {
    now = memory.load(kData + line * kLineBytes, now) + 4;
  }
  EXPECT_LT(now, 1000u * 80);
  EXPECT_LT(memory.counts().l2_misses, 5u);
  EXPECT_NEAR(static_cast<double>(memory.counts().ddr_reads), 1000, 5);
}

TEST(MemorySystem, ADirtyLineIsWrittenWhenItLeaves) {
  MemorySystem memory(quiet());
  Cycle now = 0;
  for (std::uint32_t offset = 0; offset < 2 * 1024 * 1024; offset += kLineBytes) {
    now = memory.store(kData + offset, 4, now) + 200;
  }
  // Both levels are full of dirty lines; everything else has left.
  EXPECT_EQ(memory.counts().data_refills, 65'536u);
  EXPECT_EQ(memory.counts().data_evictions, 65'536u - 1024);
  EXPECT_NEAR(static_cast<double>(memory.counts().ddr_writes), 32'768 - 1024, 1024);
}

TEST(MemorySystem, WholeLinesInARowAreNotRead) {
  MemorySystem memory(quiet());
  Cycle now = 0;
  for (std::uint32_t offset = 0; offset < 64 * 1024; offset += 8) {
    now = memory.store(kData + offset, 8, now) + 1;
  }
  EXPECT_EQ(memory.counts().ddr_reads, quiet().write_streaming_lines);
  EXPECT_EQ(memory.counts().streamed_lines, 2048u - quiet().write_streaming_lines);
}

TEST(MemorySystem, LinesWithAHoleAreRead) {
  MemorySystem memory(quiet());
  Cycle now = 0;
  for (std::uint32_t offset = 0; offset < 64 * 1024; offset += 8) {
    now = memory.store(kData + offset, offset % 32 == 24 ? 4 : 8, now) + 1;
  }
  EXPECT_EQ(memory.counts().ddr_reads, 2048u);
}

TEST(MemorySystem, TheStoreBufferHoldsFourMisses) {
  MemorySystem memory(quiet());
  for (std::uint32_t line = 0; line < 4; ++line) {
    EXPECT_EQ(memory.store(kData + line * 4096, 4, 0), 0u) << line;
  }
  EXPECT_GE(memory.store(kData + 4 * 4096, 4, 0), 129u);
}

TEST(MemorySystem, StoresToOneDoublewordMerge) {
  MemorySystem memory(quiet());
  for (std::uint32_t time = 0; time < 20; ++time) {
    EXPECT_EQ(memory.store(kData + 4 * (time % 2), 4, 0), 0u);
  }
}

TEST(MemorySystem, RegistersAreNotCached) {
  MemorySystem memory(quiet());
  EXPECT_EQ(memory.load(0x00a0'0200, 100), 100 + quiet().device_extra);
  EXPECT_EQ(memory.load(0x00a0'0200, 200), 200 + quiet().device_extra);
  EXPECT_EQ(memory.counts().data_refills, 0u);
}

constexpr std::uint32_t kUncached = 0x1020'0000;

struct WithUncached : MemorySystem {
  explicit WithUncached(const Constants& constants = quiet()) : MemorySystem(constants) {
    set_uncached(kUncached, 0x1000);
  }
};

// Nothing of it stays: the same field costs the same again. TRM 8.1.3: one after the other.
TEST(MemorySystem, EachFieldOfUncachedMemoryIsAJourneyToTheDdr) {
  WithUncached memory;
  EXPECT_EQ(memory.load(kUncached, 1000), 1129u);
  EXPECT_EQ(memory.load(kUncached, 2000), 2129u);
  EXPECT_EQ(memory.load(kUncached + 2, 2001), 2129u + 129);
  EXPECT_EQ(memory.counts().data_refills, 0u);
  EXPECT_EQ(memory.counts().ddr_reads, 3u);
  EXPECT_EQ(memory.load(kUncached - 4, 3000), 3129u);
  EXPECT_EQ(memory.load(kUncached - 4, 4000), 4000u) << "beside it memory is cached";
  EXPECT_EQ(memory.load(kUncached + 0x1000, 5000), 5129u);
  EXPECT_EQ(memory.load(kUncached + 0x1000, 6000), 6000u);
}

// TRM 8.1.2: INCR, up to nine times 64 bits. An LDM of eight words is four of them.
TEST(MemorySystem, OneInstructionReadsUncachedMemoryInOneBurst) {
  WithUncached memory;
  Cycle ready = 0;
  for (std::uint32_t word = 0; word < 8; ++word) {
    ready = memory.load(kUncached + 4 * word, 1000, word != 0);
  }
  EXPECT_EQ(ready, 1129u + 3 * 2);
  EXPECT_EQ(memory.counts().ddr_reads, 1u);
  EXPECT_EQ(memory.load(kUncached + 32, 1001), ready + 129) << "the next instruction's";
}

TEST(MemorySystem, UncachedStoresAreWrittenOneDoublewordAtATime) {
  Constants constants = quiet();
  constants.uncached_write = 30;
  WithUncached memory(constants);
  Cycle now = 1000;
  for (std::uint32_t word = 0; word < 64; ++word) {
    now = memory.store(kUncached + 4 * word, 4, now + 1);
  }
  EXPECT_GE(now, 1000u + 27 * 30) << "32 doublewords, of which the store buffer holds some";
  EXPECT_GE(memory.uncached_written(), 1000u + 32 * 30);
  EXPECT_LT(memory.uncached_written(), 1000u + 33 * 30);
  EXPECT_EQ(memory.counts().data_refills, 0u);
  EXPECT_EQ(memory.load(kUncached, 5000), 5129u) << "nor do they bring a line";
}

}  // namespace
}  // namespace iog::a9_model
