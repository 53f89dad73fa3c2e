// The transitions of the E2E state machine (PRS_E2EProtocol), one by one.
#include "tools/frames/supervision.hpp"

#include <gtest/gtest.h>
#include <initializer_list>

namespace iog::protection {
namespace {

using enum CheckStatus;

constexpr Supervision kSupervision{.window = 5,
                                   .init = {.min_ok = 2, .max_errors = 1},
                                   .valid = {.min_ok = 1, .max_errors = 2},
                                   .invalid = {.min_ok = 3, .max_errors = 0}};
static_assert(kSupervision.is_valid());

ChannelState after(Supervisor& supervisor, std::initializer_list<CheckStatus> checks) {
  for (const CheckStatus check : checks) {
    supervisor.update(check);
  }
  return supervisor.state();
}

ChannelState after(std::initializer_list<CheckStatus> checks) {
  Supervisor supervisor(kSupervision);
  return after(supervisor, checks);
}

TEST(Supervision, ErrorsAndSilenceAreNoData) {
  EXPECT_EQ(after({}), ChannelState::kNoData);
  EXPECT_EQ(after({kError, kNoNewData, kError}), ChannelState::kNoData);
}

TEST(Supervision, AnySignOfLifeBeginsTheTrial) {
  for (const CheckStatus check : {kOk, kRepeated, kOkSomeLost, kWrongSequence}) {
    EXPECT_EQ(after({check}), ChannelState::kInit);
  }
}

TEST(Supervision, EnoughUsableMessagesMakeItValid) {
  EXPECT_EQ(after({kOk, kOk}), ChannelState::kInit);
  EXPECT_EQ(after({kOk, kOk, kOkSomeLost}), ChannelState::kValid);
  EXPECT_EQ(after({kOk, kRepeated, kWrongSequence, kNoNewData}), ChannelState::kInit);
}

TEST(Supervision, TooManyErrorsEndTheTrial) {
  EXPECT_EQ(after({kOk, kError, kOk, kOk}), ChannelState::kValid);
  EXPECT_EQ(after({kOk, kError, kError}), ChannelState::kInvalid);
}

TEST(Supervision, AValidChannelBearsErrorsUpToItsLimit) {
  EXPECT_EQ(after({kOk, kOk, kOk, kError, kError}), ChannelState::kValid);
  EXPECT_EQ(after({kOk, kOk, kOk, kError, kError, kError}), ChannelState::kInvalid);
}

TEST(Supervision, SilenceMakesAChannelInvalidWhenTheWindowHasNoUsableMessageLeft) {
  Supervisor supervisor(kSupervision);
  EXPECT_EQ(after(supervisor, {kOk, kOk, kOk}), ChannelState::kValid);
  EXPECT_EQ(after(supervisor, {kNoNewData, kNoNewData, kNoNewData, kNoNewData}),
            ChannelState::kValid);
  EXPECT_EQ(after(supervisor, {kNoNewData}), ChannelState::kInvalid);
}

TEST(Supervision, AnInvalidChannelIsTrustedAgainWhenTheErrorsHaveLeftTheWindow) {
  Supervisor supervisor(kSupervision);
  EXPECT_EQ(after(supervisor, {kOk, kError, kError}), ChannelState::kInvalid);
  EXPECT_EQ(after(supervisor, {kOk, kOk, kOk}), ChannelState::kInvalid) << "both are still there";
  EXPECT_EQ(after(supervisor, {kOk}), ChannelState::kInvalid) << "one is";
  EXPECT_EQ(after(supervisor, {kOk}), ChannelState::kValid);
}

// Constraints of the standard on the limits.
TEST(Supervision, ContradictoryLimitsAreInvalid) {
  const auto with = [](auto change) {
    Supervision supervision = kSupervision;
    change(supervision);
    return supervision.is_valid();
  };
  EXPECT_FALSE(with([](Supervision& s) { s.window = 2; }));
  EXPECT_FALSE(with([](Supervision& s) { s.window = 33; }));
  EXPECT_FALSE(with([](Supervision& s) { s.valid.min_ok = 0; }));
  EXPECT_FALSE(with([](Supervision& s) { s.valid.min_ok = 3; }));
  EXPECT_FALSE(with([](Supervision& s) { s.invalid.max_errors = 2; }));
}

}  // namespace
}  // namespace iog::protection
