#include "lab/experiments/worst_frames/frame_limits.hpp"

#include "gtest/gtest.h"

#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

// Counted by hand: four LUX of 4 layers, 201 directions, 3 echoes; 500 cells times sqrt(2), which
// is 707.1, and one cell at either end and the first; 1024 / 32 tiles to a side.
TEST(FrameLimits, AreWhatTheCodeAllows) {
  const FrameLimits limits = frame_limits(*tools::find_vehicle("reference_car").vehicle);
  EXPECT_EQ(limits.points, 4 * 4 * 201 * 3);
  EXPECT_EQ(limits.range_m, 50);
  EXPECT_EQ(limits.cells_per_beam, 707 + 3);
  EXPECT_EQ(limits.cells, limits.points * limits.cells_per_beam);
  EXPECT_EQ(limits.tiles, 32 * 32);
}

}  // namespace
}  // namespace iog::lab
