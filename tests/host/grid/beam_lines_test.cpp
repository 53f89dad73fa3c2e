// Which lines are kept from scan to scan.
#include "grid/beam_lines.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/test_vehicles.hpp"

namespace iog::grid {
namespace {

using vehicle::Sensor;

constexpr int kQuarterDegree = 8;  // in the ticks of a LUX
constexpr int kEighthDegree = 4;

// Visits what is kept of all azimuths of a LUX: 50 degrees to the left to 60 to the right.
template <typename Visit>
void for_each_azimuth(BeamLines& lines, const Sensor& sensor, int ticks_apart, Visit&& visit) {
  constexpr int kTurn = 360 * 32;
  for (int ticks = 50 * 32; ticks > -60 * 32; ticks -= ticks_apart) {
    const auto azimuth = static_cast<std::uint32_t>((ticks + kTurn) % kTurn);
    visit(lines.azimuth(sensor, sensor.azimuths.nearest(azimuth)));
  }
}

// How many lines of each sensor are there in the second scan. One whose place another one took
// would be found again in every scan.
std::vector<int> kept_of(std::span<const Sensor> sensors, int ticks_apart) {
  const auto lines = std::make_unique<BeamLines>(sensors);
  for (const Sensor& sensor : sensors) {
    for_each_azimuth(*lines, sensor, ticks_apart,
                     [&](KeptAzimuth& kept) { kept.find_beam(sensor, 0); });
  }
  std::vector<int> counts;
  for (const Sensor& sensor : sensors) {
    counts.push_back(0);
    for_each_azimuth(*lines, sensor, ticks_apart,
                     [&](KeptAzimuth& kept) { counts.back() += kept.has_beam(0) ? 1 : 0; });
  }
  return counts;
}

TEST(BeamLines, KeepAllAzimuthsOfFourLuxInStepsOfAQuarterDegree) {
  const std::vector<Sensor> four(4, tests::OneLux::kVehicle.sensors[0]);
  EXPECT_EQ(kept_of(four, kQuarterDegree), (std::vector{440, 440, 440, 440}));
}

TEST(BeamLines, KeepAllAzimuthsOfThreeLuxInTheirFinestSteps) {
  EXPECT_EQ(kept_of(tests::ThreeLux::kVehicle.sensors, kEighthDegree),
            (std::vector{880, 880, 880}));
}

// 3,520 ticks are 817 of 832 places: one of the azimuths of each is kept, not none.
TEST(BeamLines, KeepOneAzimuthOfEachPlace) {
  const std::vector<Sensor> four(4, tests::OneLux::kVehicle.sensors[0]);
  for (const int kept : kept_of(four, kEighthDegree)) {
    EXPECT_GE(kept, 817);
  }
}

// Of two azimuths of one place the first one stays, until nobody asks for it any more.
TEST(BeamLines, KeepTheAzimuthsOfNow) {
  const std::vector<Sensor> four(4, tests::OneLux::kVehicle.sensors[0]);
  const auto lines = std::make_unique<BeamLines>(four);
  const auto ask = [&](std::uint32_t step) -> KeptAzimuth& {
    return lines->azimuth(four[1], step);
  };
  constexpr std::uint32_t kBefore = 1792;
  constexpr std::uint32_t kNow = 1794;
  ask(kBefore).find_beam(four[1], 0);
  for (int scan = 0; scan < 3; ++scan) {
    EXPECT_TRUE(ask(kBefore).has_beam(0));
    EXPECT_FALSE(ask(kNow).has_beam(0));
  }
  ask(kNow).find_beam(four[1], 0);
  EXPECT_TRUE(ask(kNow).has_beam(0));
  EXPECT_FALSE(ask(kBefore).has_beam(0));
}

}  // namespace
}  // namespace iog::grid
