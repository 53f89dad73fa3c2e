// A round seen from one flow: who gets which item, and when it is over.
#include "work/round.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace iog::work {
namespace {

class RoundOfOne : public testing::Test {
 protected:
  std::vector<std::size_t> run_;
  std::atomic<std::uint32_t> done_{0};
  Round round_;

  void open(std::size_t items) { round_.open(items, work_of(note_)); }

 private:
  struct Note {
    std::vector<std::size_t>* run;
    void operator()(std::size_t item, std::size_t /*core*/) const { run->push_back(item); }
  };
  Note note_{&run_};
};

TEST_F(RoundOfOne, HelpDoesEveryItemInRisingOrder) {
  open(5);
  EXPECT_FALSE(round_.is_done());
  const Round::Ticket last = round_.help(0, done_);
  EXPECT_EQ(run_, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(last.left(), 0U);
  EXPECT_EQ(done_, 5U);
  EXPECT_TRUE(round_.is_done());
}

TEST_F(RoundOfOne, ARoundOfNothingIsDone) {
  open(0);
  EXPECT_TRUE(round_.is_done());
  EXPECT_EQ(round_.help(0, done_).left(), 0U);
  EXPECT_TRUE(run_.empty());
}

TEST_F(RoundOfOne, RoundsAreNumberedAndTheFullestFits) {
  const std::uint16_t before = round_.look().number();
  open(Round::kMaxItems);
  EXPECT_EQ(round_.look().number(), static_cast<std::uint16_t>(before + 1));
  EXPECT_EQ(round_.look().left(), Round::kMaxItems);
  round_.help(0, done_);
  EXPECT_EQ(run_.size(), Round::kMaxItems);
  EXPECT_TRUE(round_.is_done());
}

TEST_F(RoundOfOne, TheNumberWrapsAndLeavesTheItemsAlone) {
  for (int round = 0; round < 0x1'0001; ++round) {
    open(1);
    ASSERT_EQ(round_.look().left(), 1U);
    round_.help(0, done_);
  }
  EXPECT_EQ(round_.look().number(), 1U);
  EXPECT_EQ(run_.size(), 0x1'0001U);
}

TEST_F(RoundOfOne, WhatWasSeenBeforeClaimsNothing) {
  open(2);
  Round::Ticket early = round_.look();
  Round::Ticket late = early;
  EXPECT_EQ(round_.claim(early), 0U);
  EXPECT_EQ(round_.claim(late), std::nullopt) << "somebody has taken the item";
  EXPECT_EQ(late.left(), 1U) << "the ticket of now";
  EXPECT_EQ(round_.claim(late), 1U);
  late = round_.look();
  EXPECT_EQ(round_.claim(late), std::nullopt) << "nothing is left";
}

// As many items are left as were seen, but they are another round's.
TEST_F(RoundOfOne, ATicketOfTheRoundBeforeClaimsNothing) {
  open(1);
  Round::Ticket seen = round_.look();
  round_.help(0, done_);
  open(1);
  EXPECT_EQ(round_.claim(seen), std::nullopt);
  EXPECT_EQ(seen.word, round_.look().word);
}

TEST_F(RoundOfOne, RedoDoesWhatHasNoFlagAndNothingElse) {
  open(4);
  for (std::size_t item = 0; item < 4; ++item) {
    Round::Ticket seen = round_.look();
    ASSERT_EQ(round_.claim(seen), item);
  }
  round_.finish(0);
  round_.finish(2);
  EXPECT_FALSE(round_.is_done());
  EXPECT_EQ(round_.redo(), 2U);
  EXPECT_EQ(run_, (std::vector<std::size_t>{1, 3}));
  EXPECT_TRUE(round_.is_done());
}

TEST_F(RoundOfOne, FlagsOfTheRoundBeforeSayNothing) {
  open(3);
  round_.help(0, done_);
  open(3);
  EXPECT_FALSE(round_.is_done());
}

}  // namespace
}  // namespace iog::work
