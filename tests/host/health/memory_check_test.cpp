// What must not change, and a reader that finds out, evenly over time.
#include "health/memory_check.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "health/guard.hpp"

namespace iog::health {
namespace {

constexpr std::uint64_t kRoundUs = MemoryCheck::kRoundUs;
constexpr std::uint64_t kPassUs = 1000;

std::vector<std::byte> counted(std::size_t bytes) {
  std::vector<std::byte> all(bytes);
  for (std::size_t at = 0; at < bytes; ++at) {
    all[at] = static_cast<std::byte>(at * 167 + at / 251);
  }
  return all;
}

// Regions of all kinds of length: none, less than a slice, just one, just more, many.
struct Memory {
  std::vector<std::vector<std::byte>> bytes;
  std::vector<Region> regions;

  explicit Memory(const std::vector<std::size_t>& lengths) {
    for (const std::size_t length : lengths) {
      bytes.push_back(counted(length));
    }
    for (const std::vector<std::byte>& each : bytes) {
      regions.push_back({.name = "memory", .bytes = each, .crc = crc_of(each)});
    }
  }
  Memory() : Memory({0, 64, 1408, 1409, 100'000, 3}) {}
};

// Passes of the loop until something was found, or until this time.
std::optional<std::size_t> run(MemoryCheck& check, std::uint64_t from_us, std::uint64_t until_us,
                               std::uint64_t pass_us = kPassUs) {
  for (std::uint64_t now_us = from_us; now_us <= until_us; now_us += pass_us) {
    if (const auto found = check.step(now_us)) {
      return found;
    }
  }
  return std::nullopt;
}

// The value that zlib.crc32(b"123456789") has, whatever way the machine goes.
TEST(MemoryCheck, TheCrcIsThatOfZlib) {
  const std::string_view text = "123456789";
  EXPECT_EQ(crc_of(std::as_bytes(std::span(text))), 0xCBF43926U);
}

TEST(MemoryCheck, WhatDoesNotChangeIsReadRoundAfterRound) {
  const Memory memory;
  MemoryCheck check(memory.regions);
  EXPECT_EQ(check.look_at_all(), std::nullopt);
  EXPECT_EQ(run(check, 7, 10 * kRoundUs + 7), std::nullopt);
  EXPECT_GE(check.rounds(), 9U);
  EXPECT_LE(check.rounds(), 10U);
}

// Each bit of a small region, a bit of each slice of a large one, each region.
TEST(MemoryCheck, AnyBitThatFlipsIsFoundWithinTwoRounds) {
  Memory memory;
  for (std::size_t region = 0; region < memory.bytes.size(); ++region) {
    std::vector<std::byte>& bytes = memory.bytes[region];
    const std::size_t step = bytes.size() <= 64 ? 1 : 7 * MemoryCheck::kSliceBytes + 1;
    for (std::size_t bit = 0; bit < 8 * bytes.size(); bit += step) {
      const auto flip = static_cast<std::byte>(1U << bit % 8);
      MemoryCheck check(memory.regions);
      ASSERT_EQ(run(check, 0, kRoundUs / 3), std::nullopt);
      bytes[bit / 8] ^= flip;
      EXPECT_EQ(check.look_at_all(), region);
      EXPECT_EQ(run(check, kRoundUs / 3 + kPassUs, 3 * kRoundUs), region) << "bit " << bit;
      bytes[bit / 8] ^= flip;
    }
  }
}

TEST(MemoryCheck, OfTwoDamagedRegionsEachIsFound) {
  Memory memory;
  MemoryCheck check(memory.regions);
  memory.bytes[1][5] ^= std::byte{1};
  memory.bytes[4][5] ^= std::byte{1};
  EXPECT_EQ(run(check, 0, kRoundUs), 1U);
  EXPECT_EQ(run(check, kRoundUs + kPassUs, 2 * kRoundUs), 4U) << "it goes on behind the first";
}

// docs/safety.md: a round lasts at most 10 s, also of 5 MiB under a loop whose passes last 20 ms.
TEST(MemoryCheck, ARoundOfTheLargestImageLastsLessThanTenSecondsInASlowLoop) {
  const std::vector<std::byte> bytes(std::size_t{5} << 20);
  const std::vector<Region> regions = {{.name = "image", .bytes = bytes, .crc = crc_of(bytes)}};
  MemoryCheck check(regions);
  EXPECT_EQ(run(check, 0, 10'000'000, 20'000), std::nullopt);
  EXPECT_GE(check.rounds(), 1U);
}

// A step reads a bounded number of slices, however late it comes.
TEST(MemoryCheck, ALoopThatStoodStillMakesUpForItBitByBit) {
  Memory memory({1'000'000});
  MemoryCheck check(memory.regions);
  ASSERT_EQ(check.step(0), std::nullopt);
  memory.bytes[0].back() ^= std::byte{1};
  std::size_t steps = 1;
  while (!check.step(100 * kRoundUs)) {
    ++steps;
  }
  const std::size_t slices = 1'000'000 / MemoryCheck::kSliceBytes + 1;
  EXPECT_EQ(steps, (slices + MemoryCheck::kMostSlices - 1) / MemoryCheck::kMostSlices);
}

// Of a round, each tenth reads a tenth: no moment is dearer than another.
TEST(MemoryCheck, SlicesAreSpreadEvenly) {
  Memory memory({1'408'000});
  MemoryCheck check(memory.regions);
  ASSERT_EQ(check.step(0), std::nullopt);
  memory.bytes[0].back() ^= std::byte{1};
  EXPECT_EQ(run(check, kPassUs, kRoundUs * 99 / 100), std::nullopt) << "the end is read last";
  EXPECT_EQ(run(check, kRoundUs * 99 / 100, kRoundUs + kPassUs), 0U);
}

TEST(MemoryCheck, WithoutRegionsThereIsNothingToFind) {
  MemoryCheck check({});
  EXPECT_EQ(check.look_at_all(), std::nullopt);
  EXPECT_EQ(run(check, 0, 3 * kRoundUs), std::nullopt);
  EXPECT_GE(check.rounds(), 2U) << "a check that has nothing to do comes round all the same";
}

TEST(Guard, IsARegionOnceItIsSet) {
  Guard guard;
  guard.set();
  const std::vector<Region> regions = {
      {.name = "guard", .bytes = guard.bytes(), .crc = crc_of(guard.bytes())}};
  const MemoryCheck check(regions);
  EXPECT_EQ(check.look_at_all(), std::nullopt);
  for (std::uint32_t& word : guard.words) {
    EXPECT_NE(word, 0U);
    word = 0;
    EXPECT_EQ(check.look_at_all(), 0U);
    word = Guard::kWord;
  }
  EXPECT_EQ(sizeof(Guard) % 64, 0U);
}

}  // namespace
}  // namespace iog::health
