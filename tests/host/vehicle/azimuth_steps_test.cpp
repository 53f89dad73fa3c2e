// The nearest azimuth step, against a search for the nearest multiple (docs/model.md section 5).
#include "vehicle/azimuth_steps.hpp"

#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/test_vehicles.hpp"

namespace iog::vehicle {
namespace {

// Azimuths and steps in parts of 1 / (T N) of a turn are whole numbers. Of two steps that are
// equally near the upper one counts, and step N is step 0.
std::uint32_t nearest_by_search(std::uint32_t ticks, std::int64_t turn, std::int64_t steps) {
  const std::int64_t azimuth = ticks * steps;
  std::int64_t best = 0;
  for (std::int64_t step = azimuth / turn; step <= azimuth / turn + 1; ++step) {
    const std::int64_t before =
        azimuth > best * turn ? azimuth - best * turn : best * turn - azimuth;
    const std::int64_t now = azimuth > step * turn ? azimuth - step * turn : step * turn - azimuth;
    best = now <= before ? step : best;
  }
  return static_cast<std::uint32_t>(best % steps);
}

TEST(AzimuthSteps, TheNearestStepIsTheNearest) {
  for (const std::uint32_t turn : {36'000U, 11'520U, 65'536U, 1'001U}) {
    for (const std::uint32_t steps : {256U, 1'024U, 4'096U, 8'192U, 16'384U}) {
      const AzimuthSteps azimuths(turn, steps);
      ASSERT_TRUE(azimuths.is_valid()) << turn << " " << steps;
      const auto stride = static_cast<std::uint32_t>(tests::effort(1, 3));
      for (std::uint32_t ticks = 0; ticks < turn; ticks += stride) {
        ASSERT_EQ(azimuths.nearest(ticks), nearest_by_search(ticks, turn, steps))
            << ticks << " of " << turn << ", " << steps << " steps";
      }
    }
  }
}

// Two ticks are a step, so odd ticks are ties.
TEST(AzimuthSteps, ATieGoesUpwardsAndATurnIsZero) {
  const AzimuthSteps azimuths(16, 8);
  EXPECT_EQ(azimuths.nearest(0), 0U);
  EXPECT_EQ(azimuths.nearest(1), 1U);
  EXPECT_EQ(azimuths.nearest(2), 1U);
  EXPECT_EQ(azimuths.nearest(3), 2U);
  EXPECT_EQ(azimuths.nearest(14), 7U);
  EXPECT_EQ(azimuths.nearest(15), 0U);
}

TEST(AzimuthSteps, WithAStepATickNothingIsRounded) {
  const AzimuthSteps azimuths(11'520, 11'520);
  for (std::uint32_t ticks = 0; ticks < 11'520; ++ticks) {
    ASSERT_EQ(azimuths.nearest(ticks), ticks);
  }
}

TEST(AzimuthSteps, TellsWhatDoesNotFit) {
  EXPECT_FALSE(AzimuthSteps(65'537, 16'384).is_valid());
  EXPECT_TRUE(AzimuthSteps(65'535, 16'384).is_valid());
}

// Worked out by hand: 2 pi 50 m / 10 cm = 3,142 steps, 2 pi 73 m / 10 cm = 4,587.
TEST(AzimuthSteps, ByDefaultAStepIsAtMostACellWideAtTheLongestRange) {
  EXPECT_EQ(tests::ManyLayers::kVehicle.sensors[0].azimuths.steps_per_turn(), 4'096U);
  EXPECT_EQ(tests::LevelVlp16::kVehicle.sensors[0].azimuths.steps_per_turn(), 8'192U);
  EXPECT_EQ(tests::OneLux::kVehicle.sensors[0].azimuths.steps_per_turn(), 11'520U);
}

}  // namespace
}  // namespace iog::vehicle
