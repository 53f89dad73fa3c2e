// Which tiles are drawn when, and why none is.
#include "map/layer.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "map/layer_bench.hpp"

namespace iog::map {
namespace {

TEST(BlurRadius, IsTheSumOfAllThatIsUncertainInCellsRoundedUp) {
  EXPECT_EQ(blur_radius(0, {1, 1}), (0 + 2 + 1 + 140 + 99) / 100U);
  EXPECT_EQ(blur_radius(300, {30, 60}), 6U);  // 560 mm
  EXPECT_EQ(blur_radius(340, {30, 60}), 6U);  // 600 mm
  EXPECT_EQ(blur_radius(341, {30, 60}), 7U);
  EXPECT_EQ(blur_radius(65'535, {65'535, 65'535}), 2623U);  // 262,280 mm
  EXPECT_EQ(blur_radius(300, {30, 60}, 200), 4U);           // 700 mm
  EXPECT_EQ(blur_radius(300, {30, 60}, 500), 3U);           // 1,120 mm
}

TEST(Layer, DrawsEachTileAsLoopsOverCellsAndEdgesDo) {
  const tests::ReferenceBlock description = town(1);
  const WrittenBlock map(description);
  ASSERT_EQ(check(map.bytes()), Refusal::kNone);
  LayerBench bench(map);
  bench.settle(map);
  EXPECT_EQ(bench.layer->report().cause, Cause::kNone);
  EXPECT_EQ(bench.layer->report().tiles_drawn, window::kSlotCount);
  tests::Random random(2);
  for (int i = 0; i < tests::effort(40, 3); ++i) {
    const std::size_t slot = random.below(window::kSlotCount);
    ASSERT_EQ(classes_of(bench.window->view().tile(slot).ruled_out),
              expected(description, bench.place(slot), 6))
        << slot;
  }
}

// Neighbours are drawn by themselves, and fit: a cell at a border is blurred over it.
TEST(Layer, NoBorderOfTilesShows) {
  const tests::ReferenceBlock description = town(3);
  const WrittenBlock map(description);
  LayerBench bench(map);
  bench.settle(map);
  const std::size_t slot = window::slot_of({0, 0});
  const std::size_t right = window::slot_of({1, 0});
  const FrameClasses own = own_classes(description, bench.place(slot));
  const FrameClasses of_right = own_classes(description, bench.place(right));
  for (std::size_t y = 0; y < kFrameSide; ++y) {
    for (std::size_t x = 0; x < kFrameSide / 2; ++x) {
      ASSERT_EQ(own[y][x + kFrameSide / 2], of_right[y][x]);
    }
  }
}

TEST(Layer, ATileThatEntersIsAnythingAtOnceAndDrawnInItsTurn) {
  const WrittenBlock map(town(7));
  LayerBench bench(map);
  bench.settle(map);
  const window::Area before = bench.window->view().area();
  bench.go_to(10, 0);
  bench.layer->work(&map.block(), bench.transform, *bench.window);
  const window::Area after = bench.window->view().area();
  std::size_t entered = 0;
  for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
    entered += before.tile_at(slot) == after.tile_at(slot) ? 0U : 1U;
  }
  EXPECT_GE(entered, 64U);
  EXPECT_EQ(bench.layer->report().tiles_withdrawn, entered);
  EXPECT_EQ(bench.layer->report().tiles_waiting + bench.layer->report().tiles_finished, entered);
  bench.settle(map);
  LayerBench afresh(map);
  afresh.go_to(10, 0);
  afresh.settle(map);
  for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
    if (afresh.window->view().area().tile_at(slot) == after.tile_at(slot)) {
      ASSERT_EQ(afresh.window->view().tile(slot).ruled_out,
                bench.window->view().tile(slot).ruled_out);
    }
  }
}

// In a window of 9 by 6 tiles, each tile inside has the mask of a window of 32 by 32, and no other
// has one, wherever the car has been.
TEST(Layer, InARectangleOnlyTilesInsideAreDrawn) {
  const WrittenBlock map(town(11));
  LayerBench bench(map, {.columns = 9, .rows = 6});
  LayerBench whole(map);
  for (const auto& [x_m, y_m] : {std::pair{0, 0}, {10, 0}, {4, -7}, {-30, 5}, {0, 0}}) {
    bench.go_to(x_m, y_m);
    whole.go_to(x_m, y_m);
    bench.frame(map);
    bench.settle(map);
    whole.settle(map);
    EXPECT_EQ(bench.layer->report().tiles_drawn, 54U);
    const window::Area area = bench.window->view().area();
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      const window::TileNumber tile = area.tile_at(slot);
      if (!area.contains(tile)) {
        ASSERT_TRUE(bench.is_anything(slot)) << slot;
      } else {
        ASSERT_EQ(bench.window->view().tile(slot).ruled_out,
                  whole.window->view().tile(slot).ruled_out);
      }
    }
  }
  bench.transform.local_frame = {2'000'000, 0, 0};
  bench.settle(map);
  EXPECT_EQ(bench.layer->report().cause, Cause::kOutside);
  EXPECT_EQ(bench.layer->report().tiles_outside, 54U);
}

TEST(Layer, EachCauseIsMetCountedAndLeavesNothingRuledOut) {
  const WrittenBlock map(town(8));
  LayerBench bench(map);
  const Block* block = &map.block();
  const auto expect = [&](Cause cause, const Block* by,
                          const std::optional<pose::MapTransform>& at) {
    bench.settle(map);
    ASSERT_EQ(bench.masks(), window::kSlotCount);
    const std::uint32_t begun = bench.layer->report().begun[static_cast<std::size_t>(cause)];
    for (int frame = 0; frame < 3; ++frame) {
      const LayerReport& report = bench.frame(by, at);
      EXPECT_EQ(report.cause, cause);
      EXPECT_EQ(report.begun[static_cast<std::size_t>(cause)], begun + 1);
      EXPECT_EQ(report.tiles_withdrawn, frame == 0 ? window::kSlotCount : 0);
      EXPECT_EQ(report.tiles_drawn + report.tiles_waiting + report.tiles_outside, 0);
      EXPECT_EQ(report.work, 0U);
      ASSERT_EQ(bench.masks(), 0U);
    }
  };
  expect(Cause::kNoMap, nullptr, bench.transform);
  expect(Cause::kNoTransform, block, std::nullopt);
  pose::MapTransform other = bench.transform;
  ++other.origin;
  expect(Cause::kOtherOrigin, block, other);
  other = bench.transform;
  other.sigma.position_mm = 301;
  expect(Cause::kImprecise, block, other);
  other.sigma = {300, 561};  // 300 + 600 + 561 + 140 mm
  expect(Cause::kBlurred, block, other);
  other.sigma = {300, 560};
  EXPECT_EQ(bench.frame(block, other).cause, Cause::kNone);
  EXPECT_EQ(bench.layer->report().radius, 16);
  EXPECT_EQ(bench.layer->report().begun[0], 6U);
}

TEST(Layer, OutsideOfTheMapNothingIsRuledOut) {
  tests::ReferenceBlock far = town(9);
  const WrittenBlock map(far);
  LayerBench bench(map);
  bench.transform.local_frame = {2'000'000, 0, 0};
  bench.settle(map);
  EXPECT_EQ(bench.layer->report().cause, Cause::kOutside);
  EXPECT_EQ(bench.layer->report().tiles_outside, window::kSlotCount);
  EXPECT_EQ(bench.masks(), 0U);
  bench.transform.local_frame = {1'000'000, 0, 0};  // the extent's border crosses the window
  bench.settle(map);
  EXPECT_EQ(bench.layer->report().cause, Cause::kNone);
  const std::size_t drawn = bench.layer->report().tiles_drawn;
  EXPECT_GT(drawn, window::kSlotCount / 3);
  EXPECT_LT(drawn, window::kSlotCount * 2 / 3);
  EXPECT_EQ(drawn + bench.layer->report().tiles_outside, window::kSlotCount);
}

TEST(Layer, AWindowWithoutAPlaceIsDrawnOnceItHasOne) {
  const WrittenBlock map(town(10));
  LayerBench bench(map);
  const int frames = bench.settle(map);
  const std::vector<TileClasses> classes = bench.classes();
  bench.window->forget();
  EXPECT_EQ(bench.frame(map).cause, Cause::kNoPlace);
  bench.window->follow({});
  EXPECT_EQ(bench.settle(map), 1) << "all is as it was";
  EXPECT_EQ(bench.classes(), classes);
  bench.window->forget();
  bench.window->follow({2'000'000'000 / 4, 0, 0});
  bench.frame(map);
  EXPECT_EQ(bench.masks(), 0U);
  EXPECT_GT(frames, 1);
}

TEST(Layer, AnotherMapIsDrawnAnew) {
  const WrittenBlock one(town(11));
  const WrittenBlock two(town(12));
  LayerBench bench(one);
  bench.settle(one);
  const LayerReport& report = bench.frame(two);
  EXPECT_EQ(report.tiles_withdrawn, window::kSlotCount);
  EXPECT_EQ(report.crc, two.block().crc());
  bench.settle(two);
  LayerBench afresh(two);
  afresh.settle(two);
  EXPECT_EQ(bench.classes(), afresh.classes());
}

// Delivered again, the same map is where it is: in other bytes.
TEST(Layer, TheSameMapInOtherBytesChangesNothing) {
  const WrittenBlock one(town(13));
  const WrittenBlock two(town(13));
  LayerBench swapped(one);
  LayerBench steady(one);
  for (int frame = 0; frame < 60; ++frame) {
    swapped.frame(frame % 7 < 3 ? one : two);
    steady.frame(one);
  }
  swapped.settle(two);
  steady.settle(one);
  EXPECT_EQ(swapped.layer->report().begun[0], 1U);
  EXPECT_EQ(swapped.classes(), steady.classes());
}

TEST(Layer, ATransformThatMovesNoCornerByMoreThanACellChangesNothing) {
  const WrittenBlock map(town(14));
  LayerBench bench(map);
  bench.settle(map);
  const std::vector<TileClasses> classes = bench.classes();
  bench.transform.local_frame.x_mm += geometry::kCellMm;
  EXPECT_EQ(bench.frame(map).tiles_withdrawn, 0);
  EXPECT_EQ(bench.classes(), classes);
  bench.transform.local_frame.x_mm += 1;
  EXPECT_EQ(bench.frame(map).tiles_withdrawn, window::kSlotCount);
  bench.settle(map);
  LayerBench afresh(map);
  afresh.transform = bench.transform;
  afresh.settle(map);
  EXPECT_EQ(bench.classes(), afresh.classes());
}

// 2^-32 turns * 1e7 are 14.6 mrad: 6.8 m off the local frame's origin they are a cell.
TEST(Layer, ATurnedTransformWithdrawsTheTilesFarFromItsOrigin) {
  const WrittenBlock map(town(15));
  LayerBench bench(map);
  bench.settle(map);
  const pose::Pose before = bench.transform.local_frame;
  bench.transform.local_frame.heading += 10'000'000;
  bench.layer->work(&map.block(), bench.transform, *bench.window);
  std::size_t moved = 0;
  for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
    const window::TileNumber tile = bench.window->view().area().tile_at(slot);
    moved += has_moved(tile, before, bench.transform.local_frame) ? 1U : 0U;
  }
  EXPECT_EQ(bench.layer->report().tiles_withdrawn, moved);
  EXPECT_LT(moved, window::kSlotCount);
  EXPECT_GT(moved, window::kSlotCount - 40);
}

TEST(Layer, AWiderBlurWithdrawsAndANarrowerOneDoesNot) {
  const WrittenBlock map(town(16));
  LayerBench bench(map);
  bench.settle(map);
  bench.transform.sigma.position_mm = 200;
  EXPECT_EQ(bench.frame(map).tiles_withdrawn, window::kSlotCount);
  bench.settle(map);
  const std::vector<TileClasses> wide = bench.classes();
  bench.transform.sigma = kSigma;
  EXPECT_EQ(bench.frame(map).tiles_withdrawn, 0);
  EXPECT_EQ(bench.frame(map).radius, 6);
  EXPECT_EQ(bench.classes(), wide);
}

// All around the car is free, also where the town has houses; beyond the town there are none.
TEST(Layer, AMapThatIsContradictedNamesNothingUntilItAgrees) {
  const WrittenBlock map(town(20));
  LayerBench bench(map);
  bench.free_around();
  bench.settle(map);
  const std::vector<TileClasses> classes = bench.classes();
  const auto frames_until = [&](Cause cause) {
    int frames = 1;
    while (bench.frame(map).cause != cause && frames < 400) {
      ++frames;
    }
    return frames;
  };
  EXPECT_LE(frames_until(Cause::kContradicted), 3 * 16);
  EXPECT_EQ(bench.masks(), 0U);
  EXPECT_EQ(bench.layer->report().tiles_drawn, window::kSlotCount);
  EXPECT_EQ(frames_until(Cause::kNone), 400) << "it stays wrong";

  const pose::MapTransform before = bench.transform;
  bench.transform.local_frame.x_mm += 400'000;
  bench.settle(map);
  const int frames = frames_until(Cause::kNone);
  EXPECT_GT(frames, 14 * 16);
  EXPECT_LE(frames, 17 * 16);
  bench.transform = before;
  bench.settle(map);
  EXPECT_EQ(bench.classes(), classes);

  frames_until(Cause::kContradicted);
  bench.frame(nullptr);
  EXPECT_EQ(bench.frame(map).cause, Cause::kContradicted) << "the same map is as wrong";
  EXPECT_EQ(bench.frame(WrittenBlock(town(21))).cause, Cause::kNone) << "another may be right";
}

// Whatever happens in which order: what is shown is what a fresh layer would draw by the basis of
// the tile, and at the end that of the newest inputs.
TEST(Layer, AfterAnyHistoryItIsAsIfDrawnAfresh) {
  tests::Random random(17);
  const WrittenBlock one(town(18, 4'000));
  const WrittenBlock two(town(19, 4'000));
  for (int run = 0; run < tests::effort(6, 1); ++run) {
    LayerBench bench(one);
    const WrittenBlock* map = &one;
    for (int frame = 0; frame < 60; ++frame) {
      switch (random.below(8)) {
        case 0:
          map = random.one_in(2) ? &one : &two;
          break;
        case 1:
          bench.go_to(random.between(-20, 20), random.between(-20, 20));
          break;
        case 2:
          bench.transform.local_frame.x_mm += random.between(-150, 150);
          break;
        case 3:
          bench.frame(nullptr);
          break;
        default:
          break;
      }
      const LayerReport& report = bench.frame(*map);
      ASSERT_LE(report.work, kWorkPerFrame);
      ASSERT_EQ(report.tiles_drawn + report.tiles_waiting + report.tiles_outside,
                window::kSlotCount);
      ASSERT_EQ(bench.masks(), report.tiles_drawn);
    }
    bench.transform.local_frame.x_mm += 5'000;
    bench.settle(*map);
    const window::Area area = bench.window->view().area();
    for (const std::size_t slot : {random.below(1024), random.below(1024), random.below(1024)}) {
      const TilePlace place(bench.transform.local_frame, area.tile_at(slot));
      ASSERT_EQ(classes_of(bench.window->view().tile(slot).ruled_out),
                expected(town(map == &one ? 18 : 19, 4'000), place, 6));
    }
  }
}

}  // namespace
}  // namespace iog::map
