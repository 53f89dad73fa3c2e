#include "lab/experiments/frame_bound.hpp"

#include <string_view>
#include <utility>
#include <vector>

#include "gtest/gtest.h"

#include "lab/experiments/a9_frame.hpp"
#include "lab/scenarios/worst_frames.hpp"
#include "tools/simulate/scene_catalogue.hpp"

namespace iog::lab {
namespace {

// Counted by hand: four LUX of 4 layers, 201 directions, 3 echoes; 500 cells times sqrt(2), which
// is 707.1, and one cell at either end and the first; 1024 / 32 tiles to a side.
TEST(FrameBound, CountsWhatTheCodeAllows) {
  const FrameBound bound = frame_bound();
  EXPECT_EQ(bound.points, 4 * 4 * 201 * 3);
  EXPECT_EQ(bound.cells_per_beam, 707 + 3);
  EXPECT_EQ(bound.cells, bound.points * bound.cells_per_beam);
  EXPECT_EQ(bound.tiles, 32 * 32);
}

TEST(FrameBound, IsAboveEveryFrameThatWasMeasured) {
  const FrameBound bound = frame_bound();
  std::vector<std::pair<std::string_view, A9Frame>> runs;
  for (const tools::SceneEntry& scene : tools::all_scenes()) {
    runs.emplace_back(scene.name, a9_frame(scene.name, 4));
  }
  for (const WorstFrame& worst : all_worst_frames()) {
    runs.emplace_back(worst.name, a9_worst_frame(worst.name));
  }
  for (const auto& [run, cost] : runs) {
    EXPECT_LE(cost.points, bound.points) << run;
    EXPECT_LE(cost.cells, cost.points * bound.cells_per_beam) << run;
    EXPECT_LE(cost.fuse + cost.mark, bound.fuse_and_mark()) << run;
    EXPECT_LE(cost.publish, bound.publish()) << run;
    EXPECT_LE(cost.receive, bound.receive) << run;
    EXPECT_LE(cost.largest, bound.whole()) << run;
  }
}

// A bound far above what can happen would say nothing. It counts with a walk for each beam: a frame
// whose beams share no line comes near to it, for its number of points.
TEST(FrameBound, IsNotFarFromAFrameWithoutSharedLines) {
  const A9Frame apart = a9_worst_frame("random_azimuths");
  const double beams = apart.points / frame_bound().points;
  EXPECT_GT(apart.fuse + apart.mark, 0.75 * beams * frame_bound().fuse_and_mark());
}

}  // namespace
}  // namespace iog::lab
