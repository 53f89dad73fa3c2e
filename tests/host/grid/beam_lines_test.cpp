// Which lines are kept from scan to scan.
#include "grid/beam_lines.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <memory>

#include "fakes/test_vehicles.hpp"

namespace iog::grid {
namespace {

using vehicle::Sensor;

// Visits what is kept of all azimuths of a LUX: 50 degrees to the left to 60 to the right, in 32nds
// of a degree, in steps of a quarter.
template <typename Visit>
void for_each_azimuth(BeamLines& lines, const Sensor& sensor, Visit&& visit) {
  constexpr int kTurn = 360 * 32;
  for (int ticks = 50 * 32; ticks > -60 * 32; ticks -= 8) {
    const auto azimuth = static_cast<std::uint32_t>((ticks + kTurn) % kTurn);
    visit(lines.azimuth(sensor, sensor.azimuths.nearest(azimuth)));
  }
}

// A line whose place another one took would be found again in every scan.
TEST(BeamLines, KeepAllAzimuthsOfThreeLuxInStepsOfAQuarterDegree) {
  const auto lines = std::make_unique<BeamLines>(tests::ThreeLux::kVehicle.sensors);
  for (const Sensor& sensor : tests::ThreeLux::kVehicle.sensors) {
    for_each_azimuth(*lines, sensor, [&](KeptAzimuth& kept) { kept.find_beam(sensor, 0); });
  }
  for (const Sensor& sensor : tests::ThreeLux::kVehicle.sensors) {
    int kept_count = 0;
    for_each_azimuth(*lines, sensor,
                     [&](KeptAzimuth& kept) { kept_count += kept.has_beam(0) ? 1 : 0; });
    EXPECT_EQ(kept_count, 440);
  }
}

}  // namespace
}  // namespace iog::grid
