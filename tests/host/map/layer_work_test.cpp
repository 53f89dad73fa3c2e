// How much of the map is drawn in a frame, and in which order.
#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/effort.hpp"
#include "map/layer_bench.hpp"

namespace iog::map {
namespace {

TEST(Layer, WorksNoMoreThanItsBudgetInAFrame) {
  const WrittenBlock map(town(4));
  LayerBench bench(map);
  std::uint32_t finished = 0;
  for (int frame = 0; finished < window::kSlotCount; ++frame) {
    ASSERT_LT(frame, 1000);
    const LayerReport& report = bench.frame(map);
    EXPECT_LE(report.work, kWorkPerFrame);
    EXPECT_LE(report.tiles_finished, kWorkPerFrame / kWorkPerTile);
    EXPECT_GT(report.tiles_finished, 0);
    finished += report.tiles_finished;
    EXPECT_EQ(report.tiles_drawn, finished);
    EXPECT_EQ(report.tiles_waiting, window::kSlotCount - finished);
    EXPECT_EQ(bench.masks(), finished);
  }
  EXPECT_EQ(bench.frame(map).work, 0U);
}

TEST(Layer, TilesThatBeganToWaitTogetherAreDrawnBySlot) {
  const WrittenBlock map(town(5));
  LayerBench bench(map);
  while (bench.frame(map).tiles_waiting > 0) {
    const std::vector<bool> anything = bench.anything();
    EXPECT_TRUE(std::ranges::is_sorted(anything));
  }
}

// While all tiles still wait, the window moves twice by a tile: what entered first is drawn first,
// and last what entered last, whatever its slot.
TEST(Layer, TilesAreDrawnInTheOrderInWhichTheyBeganToWait) {
  const WrittenBlock map(town(6));
  LayerBench bench(map);
  std::vector<std::uint32_t> since(window::kSlotCount, 0);
  window::Area area = bench.window->view().area();
  std::uint32_t last = 0;
  std::size_t last_slot = 0;
  std::vector<bool> before = bench.anything();
  for (std::uint32_t frame = 1; frame < 400; ++frame) {
    if (frame == 3 || frame == 5) {
      bench.go_to(frame == 3 ? -8 : -16, frame == 3 ? 0 : 8);
    }
    const window::Area next = bench.window->view().area();
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      if (frame == 1 || next.tile_at(slot) != area.tile_at(slot)) {
        since[slot] = frame;
        before[slot] = true;
      }
    }
    area = next;
    bench.frame(map);
    const std::vector<bool> after = bench.anything();
    for (std::uint32_t began = 1; began <= frame; ++began) {
      for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
        if (since[slot] == began && before[slot] && !after[slot]) {
          ASSERT_TRUE(began > last || (began == last && slot > last_slot)) << slot;
          last = began;
          last_slot = slot;
        }
      }
    }
    before = after;
  }
  EXPECT_EQ(last, 5U);
  EXPECT_EQ(bench.layer->report().tiles_waiting, 0);
}

constexpr int kTeeth = tests::effort(14'000, 5'000);
constexpr int kEdges = 2 * kTeeth + 2;
constexpr int kBudget = kWorkPerFrame;
static_assert(kEdges > kBudget);

// One building of more edges than a frame's budget.
tests::ReferenceBlock comb(std::int32_t teeth) {
  tests::ReferenceRing ring{{-9'000, -9'000}};
  for (std::int32_t tooth = 0; tooth < teeth; ++tooth) {
    const std::int32_t x = -9'000 + tooth * 18'000 / teeth;
    ring.insert(ring.end(), {{x, 9'000}, {x + 1, -8'990}});
  }
  ring.push_back({9'000, -9'000});
  return {.extent = kWide, .accuracy_mm = 300, .features = {{Kind::kBuilding, {ring}}}};
}

TEST(Layer, ATileOfMoreEdgesThanABudgetTakesFramesAndIsShownWhole) {
  const tests::ReferenceBlock description = comb(kTeeth);
  const WrittenBlock map(description);
  ASSERT_EQ(check(map.bytes()), Refusal::kNone);
  LayerBench bench(map);
  // So many edges, of 8,192 a frame, and some of them cross the tile.
  int frames = 1;
  for (; bench.frame(map).tiles_finished == 0 && frames < 100; ++frames) {
    EXPECT_EQ(bench.layer->report().work, kWorkPerFrame);
    EXPECT_EQ(bench.masks(), 0U) << "nothing is shown that is not whole";
  }
  EXPECT_GE(frames, 1 + kEdges / kBudget);
  EXPECT_LE(frames, 1 + (kEdges + 256) * static_cast<int>(kWorkPerCrossing) / kBudget);
  EXPECT_EQ(bench.masks(), 1U);
  EXPECT_EQ(classes_of(bench.window->view().tile(0).ruled_out),
            expected(description, bench.place(0), 6));
}

// A small step of the transform does not begin the tile anew, a large one does.
TEST(Layer, AnUnfinishedTileIsDroppedWhereADrawnOneWouldBe) {
  const tests::ReferenceBlock description = comb(kTeeth);
  const WrittenBlock map(description);
  LayerBench bench(map);
  const TilePlace place = bench.place(0);
  for (int frame = 1; frame <= kEdges / kBudget; ++frame) {
    bench.frame(map);
    ASSERT_EQ(bench.masks(), 0U);
  }
  bench.transform.local_frame.y_mm += 60;
  int frames = kEdges / kBudget;
  for (; frames < 100 && bench.masks() == 0; ++frames) {
    bench.frame(map);
  }
  EXPECT_EQ(classes_of(bench.window->view().tile(0).ruled_out), expected(description, place, 6));
  LayerBench jumping(map);
  for (int frame = 1; frame <= 2 * frames; ++frame) {
    jumping.transform.local_frame.y_mm += 101;
    jumping.frame(map);
    EXPECT_EQ(jumping.masks(), 0U);
  }
}

}  // namespace
}  // namespace iog::map
