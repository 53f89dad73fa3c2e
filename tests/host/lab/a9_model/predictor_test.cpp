// What a global history, a target cache and a return stack of eight can and cannot foresee.
#include "lab/a9_model/predictor.hpp"

#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::a9_model {
namespace {

constexpr std::uint32_t kAddress = 0x1000'8000;
constexpr std::uint32_t kTarget = 0x1000'7000;

Instruction branch(Flow flow, bool conditional = false) {
  Instruction result;
  result.kind = Kind::kBranch;
  result.flow = flow;
  result.conditional = conditional;
  return result;
}

struct Tester {
  std::uint32_t wrong_in(Flow flow, bool conditional, std::uint32_t address, std::uint32_t next) {
    return predictor.foresees(branch(flow, conditional), address, next) ? 0 : 1;
  }
  std::uint32_t conditional(bool taken) {
    return wrong_in(Flow::kJump, true, kAddress, taken ? kTarget : kAddress + 4);
  }

  Predictor predictor{10};
};

// A loop of 100 turns: once its history is known, only the exit is a surprise.
TEST(Predictor, ALoopBranchIsMispredictedOnceAtItsExit) {
  Tester tester;
  std::uint32_t wrong = 0;
  for (int repetition = 0; repetition < 100; ++repetition) {
    wrong = 0;
    for (int turn = 0; turn < 100; ++turn) {
      wrong += tester.conditional(turn < 99);
    }
  }
  EXPECT_EQ(wrong, 1u);
}

TEST(Predictor, AShortPatternIsLearned) {
  Tester tester;
  std::uint32_t wrong = 0;
  for (int turn = 0; turn < 3000; ++turn) {
    const std::uint32_t now = tester.conditional(turn % 3 == 0);
    wrong += turn < 1000 ? 0 : now;
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(Predictor, ACoinIsForeseenHalfTheTime) {
  Tester tester;
  tests::Random random(7);
  std::uint32_t wrong = 0;
  constexpr std::uint32_t kTosses = 20'000;
  for (std::uint32_t toss = 0; toss < kTosses; ++toss) {
    wrong += tester.conditional(random.one_in(2));
  }
  EXPECT_NEAR(wrong, 0.5 * kTosses, 0.02 * kTosses);
}

TEST(Predictor, AJumpIsUnknownOnceAndATargetThatChangesAlways) {
  Tester tester;
  EXPECT_EQ(tester.wrong_in(Flow::kJump, false, kAddress, kTarget), 1u);
  EXPECT_EQ(tester.wrong_in(Flow::kJump, false, kAddress, kTarget), 0u);
  std::uint32_t wrong = 0;
  for (std::uint32_t turn = 0; turn < 10; ++turn) {
    wrong += tester.wrong_in(Flow::kIndirect, false, kAddress + 64, kTarget + turn % 2 * 4);
  }
  EXPECT_EQ(wrong, 10u);
}

TEST(Predictor, AnUnconditionalJumpToTheNextInstructionIsTaken) {
  EXPECT_TRUE(goes_elsewhere(branch(Flow::kIndirect), kAddress, kAddress + 4));
  EXPECT_FALSE(goes_elsewhere(branch(Flow::kJump, true), kAddress, kAddress + 4));
}

// Eight calls fit; of twelve the four outermost returns have been overwritten.
TEST(Predictor, TheReturnStackHoldsEight) {
  for (const std::uint32_t depth : {8u, 12u}) {
    Tester tester;
    std::uint32_t wrong = 0;
    for (std::uint32_t level = 0; level < depth; ++level) {
      tester.wrong_in(Flow::kCall, false, kAddress + level * 0x100,
                      kAddress + level * 0x100 + 0x100);
    }
    for (std::uint32_t level = depth; level-- > 0;) {
      wrong += tester.wrong_in(Flow::kReturn, false, kTarget, kAddress + level * 0x100 + 4);
    }
    EXPECT_EQ(wrong, depth - 8);
  }
}

}  // namespace
}  // namespace iog::a9_model
