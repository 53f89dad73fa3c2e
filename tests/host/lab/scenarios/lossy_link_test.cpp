// What a link may do to the stream, and what a receiver makes of it: no wrong cell ever counts as
// valid, what is stale is known to be stale, and all is complete again in the eighth frame that
// comes through whole (docs/spec.md 3.4). Nor does any while the target starts over and the network
// repeats what it sent before.
#include "lab/scenarios/lossy_link.hpp"

#include <algorithm>
#include <string>

#include "gtest/gtest.h"

#include "fakes/effort.hpp"
#include "tools/drive_sample.hpp"

namespace iog::lab {
namespace {

constexpr std::uint32_t kFrames = 40;
constexpr std::uint32_t kQuietFrom = 20;

const SentStream& sent() {
  static const SentStream stream = [] {
    const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
    return sent_stream(tools::messages_of(car, tools::sample_drive(car, 7, kFrames)));
  }();
  return stream;
}

class LossyLink : public testing::TestWithParam<Harm> {};

TEST_P(LossyLink, NeverShowsAWrongCellAndIsCompleteAgainInTheEighthWholeFrame) {
  const Harm& harm = GetParam();
  const bool leaves_frames_whole = harm.drop + harm.corrupt + harm.delay == 0;
  std::uint64_t frames = 0;
  std::uint64_t whole_frames = 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(tests::effort(4, 1)); ++seed) {
    const LinkTrial trial = try_link(sent(), harm, kQuietFrom, seed);
    EXPECT_EQ(trial.wrong_tiles, 0U);
    EXPECT_LE(trial.incomplete_after, 7U);
    EXPECT_EQ(trial.restarts, 0U);
    EXPECT_EQ(trial.malformed, 0U) << "what is damaged is found before it is read";
    frames += kQuietFrom;
    whole_frames += trial.whole_frames;
  }
  EXPECT_EQ(whole_frames == frames, leaves_frames_whole) << "one seed may spare all of them";
}

// "30 % out of order" is the case 30___out_of_order.
std::string case_name(const testing::TestParamInfo<Harm>& harm) {
  std::string name = harm.param.name;
  std::ranges::replace_if(
      name, [](char letter) { return letter == ' ' || letter == '%'; }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Links, LossyLink, testing::ValuesIn(kHarms), case_name);
INSTANTIATE_TEST_SUITE_P(NoLink, LossyLink, testing::Values(Harm{.name = "all_lost", .drop = 100}),
                         case_name);

// Four runs of different drives. Run numbers go up, as after a reset, or anywhere, as after a
// power-up.
const SentStream& sent_in_runs() {
  static const SentStream stream = [] {
    const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
    std::vector<std::vector<Message>> runs;
    for (const std::uint32_t run_number : {0xFFFFFFFFU, 7U, 8U, 0x80000000U}) {
      const auto drive = tools::sample_drive(car, 70 + runs.size(), 12);
      runs.push_back(tools::messages_of(car, drive, run_number));
    }
    return sent_stream_of_runs(runs);
  }();
  return stream;
}

class RestartedTarget : public testing::TestWithParam<Harm> {};

TEST_P(RestartedTarget, ShowsNoWrongCellAndNothingOfARunThatIsOver) {
  for (const unsigned repeat : {0U, 30U, 100U}) {
    Harm harm = GetParam();
    harm.repeat = repeat;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(tests::effort(4, 1)); ++seed) {
      const auto all = static_cast<std::uint32_t>(sent_in_runs().frames.size());
      const LinkTrial trial = try_link(sent_in_runs(), harm, all, seed);
      EXPECT_EQ(trial.wrong_tiles, 0U);
      EXPECT_EQ(trial.old_frames, 0U);
      EXPECT_EQ(trial.restarts, 3U);
      EXPECT_GT(trial.fresh_tiles, trial.tiles / 4) << "and yet it shows something";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Links, RestartedTarget, testing::ValuesIn(kHarms), case_name);

// A receiver that joins a running stream is complete in its eighth frame at the latest, whichever
// frame it comes to.
TEST(LossyLink, WhoeverJoinsIsCompleteInTheEighthFrame) {
  for (std::uint32_t first = 1; first <= 16; ++first) {
    const LinkTrial trial = try_link(sent(), {.name = "late", .drop = 100}, first, 1);
    EXPECT_LE(trial.incomplete_after, 7U);
    EXPECT_EQ(trial.wrong_tiles, 0U);
  }
}

}  // namespace
}  // namespace iog::lab
