// What a link may do to the stream, and what a receiver makes of it: no wrong cell ever counts as
// valid, what is stale is known to be stale, and all is complete again in the eighth frame that
// comes through whole (docs/spec.md 3.4).
#include "lab/scenarios/lossy_link.hpp"

#include <algorithm>
#include <cstdint>
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
    return sent_stream(messages_of(car, sample_drive(car, 7, kFrames)));
  }();
  return stream;
}

class LossyLink : public testing::TestWithParam<Harm> {};

TEST_P(LossyLink, NeverShowsAWrongCellAndIsCompleteAgainInTheEighthWholeFrame) {
  const Harm& harm = GetParam();
  const bool leaves_frames_whole = harm.drop + harm.corrupt + harm.delay == 0;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(tests::effort(4, 1)); ++seed) {
    const LinkTrial trial = try_link(sent(), harm, kQuietFrom, seed);
    EXPECT_EQ(trial.wrong_tiles, 0U);
    EXPECT_LE(trial.incomplete_after, 7U);
    EXPECT_EQ(trial.restarts, 0U);
    EXPECT_EQ(trial.malformed, 0U) << "what is damaged is found before it is read";
    EXPECT_EQ(trial.whole_frames == kQuietFrom, leaves_frames_whole);
  }
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
