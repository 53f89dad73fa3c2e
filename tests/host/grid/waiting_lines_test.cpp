// What waits of lidars that turn: what is spared of it does not show.
#include "grid/waiting_lines.hpp"

#include <gtest/gtest.h>
#include <memory>

#include "fakes/cells_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fusion/frame_fusion.hpp"

namespace iog::grid {
namespace {

// Where enough beams of a line carve, nearer ones add nothing and may be spared; to the cell. Lines
// are tried with few hits and many, most of them as far as the layers of half rank are in the band.
TEST(WaitingLines, BeamsThatAreSparedAddNothing) {
  tests::Random random(55);
  for (const vehicle::Vehicle& car : {tests::ManyLayers::kVehicle, tests::HighAndFar::kVehicle}) {
    const auto waits = std::make_unique<fusion::FrameFusion>(car);
    const auto alone = std::make_unique<fusion::FrameFusion>(car);
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

}  // namespace
}  // namespace iog::grid
