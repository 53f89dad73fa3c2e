// What the target counts of itself, in words.
#include "tools/report/counters.hpp"

#include <bit>
#include <gtest/gtest.h>

namespace iog::tools {
namespace {

TEST(CounterWords, OfTheCores) {
  const auto words = [](const work::TeamCounts& counts) { return words_of(counts); };
  EXPECT_EQ(words({.at_work = 4, .items = {100, 50, 30, 20}}),
            "4, with 50, 25, 15, 10 % of the shared items");
  EXPECT_EQ(words({.at_work = 3, .for_lost = 2, .items = {3, 1, 0, 0}}),
            "3, with 75, 25, 0, 0 % of the shared items, 2 done for lost cores");
  EXPECT_EQ(words({.at_work = 1, .items = {9, 0, 0, 0}}), "1");
  EXPECT_EQ(words({.at_work = 4}), "4");
}

std::string words(std::uint32_t starts, std::uint32_t cause, std::uint32_t detail) {
  return words_of(hal::RunBefore{starts, {static_cast<hal::EndCause>(cause), detail}});
}

TEST(CounterWords, OfTheRunBefore) {
  EXPECT_EQ(words(1, 0, 0), "1 since power-up");
  EXPECT_EQ(words(2, 1, 0), "2 since power-up; before: reset without a word");
  EXPECT_EQ(words(3, 2, 4), "3 since power-up; before: exception of the processor, kind 4");
  EXPECT_EQ(words(3, 3, 77), "3 since power-up; before: requirement broken, line 77");
  EXPECT_EQ(words(9, 4, 1), "9 since power-up; before: memory has changed, region 1");
  EXPECT_EQ(words(2, 5, 0x100), "2 since power-up; before: silent: core 2");
  EXPECT_EQ(words(2, 5, 0x441),
            "2 since power-up; before: silent: datagrams, Ethernet controller, number 10");
  EXPECT_EQ(words(2, 6, 0x10100014), "2 since power-up; before: hung at 0x10100014");
  EXPECT_EQ(words(9, 200, 1), "9 since power-up; before: cause 200, 1") << "of a later target";
}

TEST(CounterWords, OfATimeOfTheLoop) {
  EXPECT_EQ(words_of(health::Durations{.worst_us = 70'000,
                                       .sum_us_high = 1,
                                       .sum_us_low = 4,
                                       .counts = {1'048'575, 0, 0, 0, 0, 0, 0, 0, 1, 1'048'576}}),
            "2048 us mean, 70000 worst, of 2097152: 50 % < 256, 0 % < 65536, 50 % >= 65536");
  EXPECT_EQ(words_of(health::Durations{}), "0 us mean, 0 worst, of 0");
}

TEST(CounterWords, OfCommands) {
  EXPECT_EQ(words_of({.kinds = {{{{120, 3, 2, 1}, 130}, {{0, 0, 0, 4}, 0}}}}, 0x1A2B3C4D),
            "signed; poses 120 authentic, 3 unsigned, 2 replayed, 1 forged; maps 4 forged; "
            "freshness 1a2b3c4d:130");
}

// One signer may send both.
TEST(CounterWords, TheNextCommandIsNewerThanAnyOfBothKinds) {
  const auto freshness = freshness_of({.kinds = {{{{1}, 130}, {{1}, 777}}}}, 5);
  EXPECT_EQ(freshness.counter, 777U);
  EXPECT_EQ(freshness.run, 5U);
}

// By `openssl mac` of OpenSSL 3.0: of 80011a2b3c4d, then the ten counters.
TEST(CounterWords, OfCommandsAreBelievedIfTheyAreSigned) {
  constexpr authentication::Key kSignersKey{std::byte{0x2B}};
  const std::array<std::uint32_t, 12> counters{120, 3, 2, 1, 130,        0,
                                               0,   0, 4, 0, 0xE67BD1CB, 0xF38397E0};
  const auto is_believed = [](const std::array<std::uint32_t, 12>& words, std::uint32_t run,
                              const authentication::Key& key) {
    return is_signed_with(key, std::bit_cast<CommandCounts>(words), run);
  };
  EXPECT_TRUE(is_believed(counters, 0x1A2B3C4D, kSignersKey));
  EXPECT_FALSE(is_believed(counters, 0x1A2B3C4E, kSignersKey));
  EXPECT_FALSE(is_believed(counters, 0x1A2B3C4D, {}));
  for (std::size_t i = 0; i < counters.size(); ++i) {
    auto changed = counters;
    changed.at(i) ^= 0x100;
    EXPECT_FALSE(is_believed(changed, 0x1A2B3C4D, kSignersKey)) << i;
  }
}

}  // namespace
}  // namespace iog::tools
