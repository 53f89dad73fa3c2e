// Sixteen bytes at once are what they are one by one, on every machine.
#include "lanes/lanes.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "lanes/lanes_plain.hpp"

namespace iog::lanes {
namespace {

// Every pair of bytes, in all lanes: the lanes of the machine against the plain ones.
template <typename Check>
void for_each_pair(Check&& check) {
  for (int a = -128; a < 128; ++a) {
    for (int b = -128; b < 128; b += static_cast<int>(kLaneCount)) {
      LaneBytes left;
      LaneBytes right;
      left.bytes.fill(static_cast<std::int8_t>(a));
      for (std::size_t i = 0; i < kLaneCount; ++i) {
        right.bytes[i] = static_cast<std::int8_t>(b + static_cast<int>(i));
      }
      check(left, right);
    }
  }
}

template <typename Operation>
void expect_the_same(Operation&& operation) {
  for_each_pair([&](const LaneBytes& a, const LaneBytes& b) {
    LaneBytes found;
    LaneBytes expected;
    operation(Lanes::load(a), Lanes::load(b)).store(found);
    operation(PlainLanes::load(a), PlainLanes::load(b)).store(expected);
    ASSERT_EQ(found.bytes, expected.bytes) << int{a.bytes[0]} << " and from " << int{b.bytes[0]};
  });
}

TEST(Lanes, AreThePlainOnes) {
  expect_the_same([](auto a, auto b) { return a.bit_and(b); });
  expect_the_same([](auto a, auto b) { return a.and_not(b); });
  expect_the_same([](auto a, auto b) { return a.bit_or(b); });
  expect_the_same([](auto a, auto b) { return a.subtract(b); });
  expect_the_same([](auto a, auto b) { return a.max(b); });
  expect_the_same([](auto a, auto b) { return a.add(b); });
  expect_the_same([](auto a, auto b) { return a.add(b).above_zero(); });
}

// docs/model.md section 3: what is carved saturates. A byte does at -128.
TEST(Lanes, SubtractDownToTheLowestByte) {
  EXPECT_EQ(int{subtract_saturated(-120, 8)}, -128);
  EXPECT_EQ(int{subtract_saturated(-120, 9)}, -128);
  EXPECT_EQ(int{subtract_saturated(0, 127)}, -127);
  EXPECT_EQ(int{subtract_saturated(-128, 127)}, -128);
  EXPECT_EQ(int{subtract_saturated(127, -128)}, 127);
}

TEST(Lanes, AddUpToTheHighestByte) {
  EXPECT_EQ(int{add_saturated(120, 7)}, 127);
  EXPECT_EQ(int{add_saturated(120, 8)}, 127);
  EXPECT_EQ(int{add_saturated(-120, -9)}, -128);
  EXPECT_EQ(int{add_saturated(127, -128)}, -1);
}

TEST(Lanes, AreLoadedFromAnyPlace) {
  std::array<std::int8_t, kLaneCount + 3> bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::int8_t>(3 * i);
  }
  for (std::size_t from = 0; from <= 3; ++from) {
    std::array<std::int8_t, kLaneCount> found{};
    Lanes::load_bytes(&bytes[from]).store_bytes(found.data());
    EXPECT_TRUE(std::equal(found.begin(), found.end(), &bytes[from]));
  }
}

TEST(Lanes, AreZeroIfAllAre) {
  LaneBytes lanes;
  EXPECT_TRUE(Lanes::load(lanes).is_zero());
  EXPECT_TRUE(PlainLanes::load(lanes).is_zero());
  for (std::int8_t& byte : lanes.bytes) {
    byte = -128;
    EXPECT_FALSE(Lanes::load(lanes).is_zero());
    EXPECT_FALSE(PlainLanes::load(lanes).is_zero());
    byte = 0;
  }
}

TEST(Lanes, PutTheRowsOfFourBlocksBesideOneAnother) {
  std::array<LaneBytes, 4> blocks;
  for (std::size_t i = 0; i < 64; ++i) {
    blocks[i / 16].bytes[i % 16] = static_cast<std::int8_t>(i);
  }
  const auto rows = Lanes::rows_of(blocks.data());
  const auto plain = PlainLanes::rows_of(blocks.data());
  for (std::size_t row = 0; row < 4; ++row) {
    std::array<std::int8_t, kLaneCount> found{};
    std::array<std::int8_t, kLaneCount> expected{};
    rows[row].store_bytes(found.data());
    plain[row].store_bytes(expected.data());
    for (std::size_t x = 0; x < kLaneCount; ++x) {
      ASSERT_EQ(static_cast<std::size_t>(found[x]), x / 4 * 16 + row * 4 + x % 4);
    }
    ASSERT_EQ(found, expected);
  }
}

}  // namespace
}  // namespace iog::lanes
