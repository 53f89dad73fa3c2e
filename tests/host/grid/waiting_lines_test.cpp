// What waits of lidars that turn: it takes room, and what is spared of it does not show.
#include "grid/waiting_lines.hpp"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>

#include "fakes/cells_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "grid/frame_fusion.hpp"

namespace iog::grid {
namespace {

using tests::HighAndFar;
using tests::LevelVlp16;
using tests::ManyLayers;
using vehicle::Fate;

// Where enough beams of a line carve, nearer ones add nothing and may be spared; to the cell. Lines
// are tried with few hits and many, most of them as far as the layers of half rank are in the band.
TEST(WaitingLines, BeamsThatAreSparedAddNothing) {
  tests::Random random(55);
  for (const vehicle::Vehicle& car : {ManyLayers::kVehicle, HighAndFar::kVehicle}) {
    const auto waits = std::make_unique<FrameFusion>(car);
    const auto alone = std::make_unique<FrameFusion>(car);
    for (int line = 0; line < tests::effort(200, 30); ++line) {
      const vehicle::Sensor& sensor =
          car.sensors[static_cast<std::size_t>(line) % car.sensors.size()];
      const auto tick = static_cast<std::uint16_t>(random.between(0, 35'999));
      const int hits = random.between(0, 14);
      const int points = hits + random.between(0, 40);
      for (int i = 0; i < points; ++i) {
        // Of the 128 layers those in the middle are within two degrees of the horizon.
        const int layers = sensor.layer_count;
        const int layer =
            i < hits ? layers / 2 + random.between(-4, 3) : random.between(0, layers - 1);
        const int range_mm = i < hits ? random.between(4'000, 12'000) : random.between(1, 55'000);
        const lidar::ScanPoint point{.range_mm = static_cast<std::uint32_t>(range_mm),
                                     .azimuth_ticks = tick,
                                     .layer = static_cast<std::uint8_t>(layer)};
        waits->add(sensor, point);
        alone->add(sensor, point);
        alone->carve_waiting();
      }
      waits->finish();
      alone->finish();
      ASSERT_EQ(tests::cells_of(*waits), tests::cells_of(*alone)) << car.name << " " << line;
      waits->clear();
      alone->clear();
    }
  }
}

// A point that waits takes the room of its mark, but only if it marks.
TEST(WaitingLines, PointsThatWaitTakeTheRoomOfTheirMarks) {
  const auto fusion = std::make_unique<FrameFusion>(LevelVlp16::kVehicle);
  const vehicle::Sensor& sensor = LevelVlp16::kVehicle.sensors[0];
  ASSERT_EQ(max_marks_per_point(sensor), 1U);
  // Layer 1 is at +1 degree, layer 0 at -15 degrees: at 30 m it would be 8 m below the sensor.
  ASSERT_EQ(fusion->add(sensor, {.range_mm = 10'000, .azimuth_ticks = 100, .layer = 1}),
            Fate::kUsed);
  ASSERT_EQ(fusion->add(sensor, {.range_mm = 30'000, .azimuth_ticks = 100, .layer = 0}),
            Fate::kOutsideHeightBand);
  EXPECT_FALSE(fusion->fits(sensor, kMaxMarks));
  EXPECT_TRUE(fusion->fits(sensor, kMaxMarks - 1));
  fusion->finish();
  EXPECT_TRUE(fusion->fits(sensor, kMaxMarks));
}

}  // namespace
}  // namespace iog::grid
