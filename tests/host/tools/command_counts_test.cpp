// What a target says of its signed commands, in words.
#include <gtest/gtest.h>

#include "tools/report/counters.hpp"

namespace iog::tools {
namespace {

// docs/spec.md 3.7: behind 185 counters of the loop and 14 of service discovery.
constexpr std::size_t kCommandsBefore = 185 + 14;

stream::FrameEnd end_with(const std::array<std::uint32_t, 12>& counters) {
  stream::FrameEnd end{};
  std::ranges::copy(counters, end.link_counters.begin() + kCommandsBefore);
  end.link_counter_count = kCommandsBefore + 12;
  return end;
}

TEST(CommandCounts, InWords) {
  const auto counts = command_counts_of(end_with({120, 3, 2, 1, 130, 0, 0, 0, 4, 0}), 0x1A2B3C4D);
  ASSERT_TRUE(counts);
  EXPECT_EQ(words_of(*counts),
            "signed; poses 120 authentic, 3 unsigned, 2 replayed, 1 forged; maps 4 forged; "
            "freshness 1a2b3c4d:130");
}

// One signer may send both.
TEST(CommandCounts, TheNextMessageIsNewerThanAnyOfBothKinds) {
  const auto counts = command_counts_of(end_with({1, 0, 0, 0, 130, 1, 0, 0, 0, 777}), 5);
  EXPECT_EQ(counts->freshness().counter, 777U);
  EXPECT_EQ(counts->freshness().run, 5U);
}

// By `openssl mac` of OpenSSL 3.0: of 80011a2b3c4d, then the ten counters.
TEST(CommandCounts, AreBelievedIfTheyAreSigned) {
  constexpr authentication::Key kKey{std::byte{0x2B}};
  const std::array<std::uint32_t, 12> counters{120, 3, 2, 1, 130,        0,
                                               0,   0, 4, 0, 0xE67BD1CB, 0xF38397E0};
  EXPECT_TRUE(command_counts_of(end_with(counters), 0x1A2B3C4D)->is_signed_with(kKey));
  EXPECT_FALSE(command_counts_of(end_with(counters), 0x1A2B3C4E)->is_signed_with(kKey));
  EXPECT_FALSE(command_counts_of(end_with(counters), 0x1A2B3C4D)->is_signed_with({}));
  for (std::size_t i = 0; i < counters.size(); ++i) {
    auto changed = counters;
    changed.at(i) ^= 0x100;
    EXPECT_FALSE(command_counts_of(end_with(changed), 0x1A2B3C4D)->is_signed_with(kKey)) << i;
  }
}

TEST(CommandCounts, OfATargetThatSignsNothingAreNone) {
  stream::FrameEnd end = end_with({});
  --end.link_counter_count;
  EXPECT_FALSE(command_counts_of(end, 1));
}

}  // namespace
}  // namespace iog::tools
