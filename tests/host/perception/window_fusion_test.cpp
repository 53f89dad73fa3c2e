// The window in time, by its laws: refresh, budget, forgetting, periods.
#include "perception/window_fusion.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "perception/frames.hpp"

namespace iog::perception {
namespace {

// One cell free in one frame, in each of many tiles.
std::vector<PlacedSlice> free_cells(int tiles) {
  Slice slice;
  for (int i = 0; i < tiles; ++i) {
    slice.set({300 + i % 12 * 32, 300 + i / 12 * 32}, -14);
  }
  return {{.slice = slice, .vehicle = {0, 0}}};
}

TEST(WindowFusion, EveryKnownTileIsRefreshedWithinEightFrames) {
  Fusion fusion;
  fusion.follow({0, 0});
  fusion.frame(free_cells(144));
  ASSERT_EQ(fusion.known_tiles(), 144U);
  std::uint32_t refreshed = 0;
  for (int frame = 1; frame <= 80; ++frame) {
    refreshed += fusion.frame({}).groups_refreshed;
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      ASSERT_TRUE(!fusion.view().is_known(slot) || fusion.view().age_frames(slot) <= 7);
    }
  }
  EXPECT_EQ(refreshed, 144U * 10);
}

// A drive is the same however long the target was idle before it.
TEST(WindowFusion, FramesBeforeTheFirstThatIsPlacedDoNotShow) {
  const auto play = [](int idle_frames) {
    const auto fusion = std::make_unique<WindowFusion>();
    for (int frame = 0; frame < idle_frames; ++frame) {
      fusion->finish(static_cast<std::uint64_t>(frame) * 40'000);
    }
    fusion->follow(at_cell({0, 0}).pose);
    std::vector<std::vector<ClassBytes>> frames;
    for (std::uint64_t frame = 0; frame < 30; ++frame) {
      for (const auto& [slice, vehicle] :
           frame < 3 ? free_cells(144) : std::vector<PlacedSlice>{}) {
        add_slice(slice, at_cell(vehicle), *fusion);
      }
      fusion->finish(1'000'000 + frame * 40'000);
      auto& tiles = frames.emplace_back(window::kSlotCount);
      for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
        fusion->view().copy_classes(slot, tiles[slot]);
      }
    }
    return frames;
  };
  EXPECT_EQ(play(0), play(3));
}

// Nor do frames in which neither evidence nor time has come.
TEST(WindowFusion, AFrameWithoutSlicesAndWithoutTimeChangesNothing) {
  Fusion fusion;
  fusion.follow({0, 0});
  fusion.frame(free_cells(144), 40'000);
  const auto before = fusion.classes();
  for (int frame = 0; frame < 10; ++frame) {
    EXPECT_EQ(fusion.frame({}, 40'000), FrameCounts{});
    EXPECT_EQ(fusion.classes(), before);
  }
  EXPECT_EQ(fusion.view().age_frames(window::slot_of({0, 0})), 0);
}

// f = 0.7, tau = 0.949 s: 0.7 exp(-t / tau) is one half at 0.32 s.
TEST(WindowFusion, WhatIsNotSeenAgainIsUnknownAtItsNextRefresh) {
  Fusion fusion;
  fusion.follow({0, 0});
  fusion.frame(free_cells(144));
  const auto free = [&] {
    std::ptrdiff_t count = 0;
    for (const ClassBytes& tile : fusion.classes()) {
      count += std::ranges::count_if(
          tile, [](std::int8_t byte) { return class_of(byte) == decision::Class::kFree; });
    }
    return count;
  };
  EXPECT_EQ(free(), 144);
  for (int frame = 1; frame <= 7; ++frame) {
    fusion.frame({});
  }
  EXPECT_EQ(free(), 144);
  for (int frame = 8; frame <= 16; ++frame) {
    fusion.frame({});
  }
  EXPECT_EQ(free(), 0);
}

// The clock's ring turns in 64 frames: what was seen long ago is not mistaken for something new.
// After 10 s nothing is left of 0.7.
TEST(WindowFusion, MuchLaterEvidenceWeighsAsMuchAsTheFirst) {
  for (const int frames : {254, 255, 256, 257, 319, 320, 321, 448}) {
    Fusion fusion;
    fusion.follow({0, 0});
    fusion.frame(free_cells(20));
    const std::vector<ClassBytes> first = fusion.classes();
    for (int frame = 0; frame < frames; ++frame) {
      fusion.frame({});
    }
    fusion.frame(free_cells(20));
    ASSERT_TRUE(fusion.classes() == first) << frames;
  }
}

// Ten tiles with a hit each, in the order of their slots: columns of tiles 0, 1, 2, then -7 to -1.
TEST(WindowFusion, HitsComeFirstBySlot) {
  constexpr std::array kColumns{0, 1, 2, -7, -6, -5, -4, -3, -2, -1};
  for (const std::uint32_t budget : {0U, 1U, 4U, 10U, 13U, 100U}) {
    Fusion fusion({.group_budget = budget});
    fusion.follow({0, 0});
    std::vector<PlacedSlice> slices = free_cells(20);
    const auto cell_of = [](int column) { return Cell{column * 32 + 12, -202}; };
    for (const int column : kColumns) {
      slices[0].slice.set({512 + cell_of(column).x, 512 + cell_of(column).y}, 2);
    }
    const FrameCounts counts = fusion.frame(slices);
    EXPECT_EQ(counts.groups_fused, std::min<std::uint32_t>(budget, 30));
    EXPECT_EQ(counts.groups_left, 30 - std::min<std::uint32_t>(budget, 30));
    for (std::uint32_t i = 0; i < kColumns.size(); ++i) {
      EXPECT_EQ(fusion.class_at(cell_of(kColumns[i])),
                i < budget ? decision::Class::kOccupied : decision::Class::kUnknown);
    }
  }
}

// Four free groups of one tile and one of another, in the order of slots and numbers.
TEST(WindowFusion, WhatIsOverBudgetIsLeftBySlotAndNumber) {
  constexpr std::array<Cell, 5> kInOrder{Cell{0, 0}, {24, 0}, {8, 1}, {0, 31}, {32, 0}};
  for (std::uint32_t budget = 0; budget <= kInOrder.size(); ++budget) {
    Fusion fusion({.group_budget = budget});
    fusion.follow({0, 0});
    PlacedSlice placed;
    for (const Cell cell : kInOrder) {
      placed.slice.set({512 + cell.x, 512 + cell.y}, -14);
    }
    fusion.frame({placed});
    for (std::uint32_t i = 0; i < kInOrder.size(); ++i) {
      EXPECT_EQ(fusion.class_at(kInOrder[i]),
                i < budget ? decision::Class::kFree : decision::Class::kUnknown);
    }
  }
}

// What is left has had no evidence: the next time it has, the time since the last one counts.
TEST(WindowFusion, WhatIsLeftOnlyAges) {
  Fusion with_budget({.group_budget = 1});
  Fusion without_evidence({.group_budget = 1});
  PlacedSlice both;
  both.slice.set({512, 512}, -14);
  both.slice.set({512 + 40, 512}, -14);
  PlacedSlice first;
  first.slice.set({512, 512}, -14);
  with_budget.follow({0, 0});
  without_evidence.follow({0, 0});
  for (int frame = 0; frame < 20; ++frame) {
    const FrameCounts counts = with_budget.frame({both});
    EXPECT_EQ(counts.groups_left, 1U);
    without_evidence.frame({first});
    ASSERT_TRUE(with_budget.classes() == without_evidence.classes());
  }
}

TEST(WindowFusion, NothingIsKnownAfterForgetting) {
  Fusion fusion;
  fusion.follow({0, 0});
  fusion.frame(free_cells(144));
  fusion.forget();
  EXPECT_EQ(fusion.known_tiles(), 0U);
  EXPECT_TRUE(fusion.classes() == std::vector<ClassBytes>(window::kSlotCount));
  EXPECT_EQ(fusion.frame(free_cells(1)).slices_outside, 1U);
  EXPECT_EQ(fusion.known_tiles(), 0U);
  fusion.follow({0, 0});
  EXPECT_EQ(fusion.frame(free_cells(1)).slices, 1U);
  EXPECT_EQ(fusion.known_tiles(), 1U);
}

// Slices before and after: of the frame in which the window is forgotten only those after count.
TEST(WindowFusion, EvidenceOfTheFrameIsForgottenToo) {
  const auto fusion = std::make_unique<WindowFusion>();
  const placing::Placement at = at_cell({0, 0});
  fusion->follow(at.pose);
  add_slice(free_cells(144)[0].slice, at, *fusion);
  fusion->forget();
  fusion->follow(at.pose);
  Slice one;
  one.set({512, 512}, 2);
  add_slice(one, at, *fusion);
  const FrameCounts counts = fusion->finish(kFrameUs);
  EXPECT_EQ(counts.slices, 1U);
  EXPECT_EQ(counts.groups_fused, 1U);
}

TEST(WindowFusion, SlicesOutsideOfTheWindowAreNotPlaced) {
  Fusion fusion;
  EXPECT_EQ(fusion.frame(free_cells(3)), (FrameCounts{.slices_outside = 1}));
  fusion.follow({0, 0});
  std::vector<PlacedSlice> far = free_cells(3);
  far[0].vehicle = {512, 0};
  EXPECT_EQ(fusion.frame(far), (FrameCounts{.slices_outside = 1}));
  far[0].vehicle = {511, -512};
  EXPECT_EQ(fusion.frame(far).slices, 1U);
}

TEST(WindowFusion, AnOlderStampCountsAsTheNewest) {
  Fusion late;
  Fusion same;
  late.follow({0, 0});
  same.follow({0, 0});
  constexpr std::array<std::uint64_t, 4> kStamps{5'000'000, 4'000'000, 4'900'000, 5'100'000};
  std::uint64_t newest = 0;
  for (const std::uint64_t stamp : kStamps) {
    newest = std::max(newest, stamp);
    late.frame(free_cells(12), stamp);
    same.frame(free_cells(12), newest);
    ASSERT_TRUE(late.classes() == same.classes());
  }
}

// Every second column of a square is free.
std::vector<PlacedSlice> striped_ground() {
  std::vector<PlacedSlice> slices(1);
  for (std::int32_t i = 0; i < 30 * 30; i += 2) {
    slices[0].slice.set({512 + i % 30, 512 + i / 30}, -14);
  }
  return slices;
}

std::vector<PlacedSlice> hits_on_stripes() {
  std::vector<PlacedSlice> slices(1);
  slices[0].slice.set({512 + 14, 512 + 14}, 2);
  slices[0].slice.set({512 + 16, 512 + 15}, 2);
  return slices;
}

// So that it is open but never dense, in four frames of each period of 480 ms. Then two cells are
// hit at once.
decision::Class hit_after(const std::vector<std::uint64_t>& periods) {
  Fusion fusion;
  fusion.follow({0, 0});
  std::uint64_t newest_us = 0;
  for (const std::uint64_t period : periods) {
    for (std::uint64_t frame = 1; frame <= 4; ++frame) {
      const std::uint64_t stamp_us = (1000 + period) * kPeriodUs + frame * kFrameUs;
      fusion.frame(striped_ground(), stamp_us);
      newest_us = std::max(newest_us, stamp_us);
    }
  }
  fusion.frame(hits_on_stripes(), newest_us + kFrameUs);
  EXPECT_EQ(fusion.class_at({14, 14}), fusion.class_at({16, 15}));
  return fusion.class_at({14, 14});
}

TEST(WindowFusion, GroundIsWellKnownWhenFoundOpenInThreeMorePeriods) {
  EXPECT_EQ(hit_after({0, 1, 2}), decision::Class::kOccupied);
  EXPECT_EQ(hit_after({0, 1, 2, 3}), decision::Class::kMoving);
  EXPECT_EQ(hit_after({0, 0, 0, 0}), decision::Class::kOccupied);
}

// Well known ground over the border of two tiles is hit in one of them, and in the next frame in
// the other alone: of a frame there is one hit, which is no arrival. If both are of one frame, it
// is.
TEST(WindowFusion, HitsOfAnotherFrameDoNotMakeAnArrival) {
  for (const bool are_together : {false, true}) {
    Fusion fusion;
    fusion.follow({0, 0});
    PlacedSlice ground;
    for (std::int32_t i = 0; i < 30 * 30; i += 2) {
      ground.slice.set({528 + i % 30, 512 + i / 30}, -14);
    }
    std::uint64_t stamp_us = 0;
    for (std::uint64_t period = 1; period <= 4; ++period) {
      for (std::uint64_t frame = 1; frame <= 4; ++frame) {
        stamp_us = period * kPeriodUs + frame * kFrameUs;
        fusion.frame({ground}, stamp_us);
      }
    }
    PlacedSlice first;
    first.slice.set({512 + 30, 512 + 14}, 2);
    PlacedSlice second = are_together ? first : PlacedSlice{};
    second.slice.set({512 + 32, 512 + 15}, 2);
    fusion.frame({are_together ? ground : first}, stamp_us + kFrameUs);
    fusion.frame({second}, stamp_us + 2 * kFrameUs);
    EXPECT_EQ(fusion.class_at({32, 15}),
              are_together ? decision::Class::kMoving : decision::Class::kOccupied);
  }
}

TEST(WindowFusion, NoPeriodBeginsWhileStampsGoBack) {
  EXPECT_EQ(hit_after({0, 1, 2, 0, 1, 2}), decision::Class::kOccupied);
}

// Kurdej 2015, section 5.2: whatever is hit where it was free has moved. In one frame on free
// ground nothing says that it is open.
TEST(WindowFusion, TheLiteralRuleLetsEverythingMove) {
  for (const Moved rule : {Moved::kOpenGround, Moved::kLiteral}) {
    Fusion fusion({.moved = rule});
    fusion.follow({0, 0});
    PlacedSlice free;
    free.slice.set({512, 512}, -14);
    PlacedSlice hit;
    hit.slice.set({512, 512}, 2);
    for (int frame = 0; frame < 3; ++frame) {
      fusion.frame({free});
    }
    fusion.frame({hit});
    EXPECT_EQ(fusion.class_at({0, 0}),
              rule == Moved::kLiteral ? decision::Class::kMoving : decision::Class::kOccupied);
  }
}

// A map that comes names what is known of every group at once, and one that goes takes it back. A
// tile of which nothing is known remembers it.
TEST(WindowFusion, AMapNamesWhatIsKnownAtOnce) {
  const auto fusion = std::make_unique<WindowFusion>();
  fusion->follow(at_cell({0, 0}).pose);
  Slice slice;
  slice.draw({512, 512}, std::vector<std::string>(32, std::string(32, '.')));
  add_slice(slice, at_cell({0, 0}), *fusion);
  fusion->finish(kFrameUs);
  const auto expect_named = [&](window::TileNumber tile, std::size_t group,
                                decision::Class by_the_map) {
    for (std::int32_t i = 0; i < 32 * 32; ++i) {
      const Cell cell{32 * tile.a + i % 32, 32 * tile.b + i / 32};
      ASSERT_EQ(class_of(fusion->view().name_of(cell)),
                static_cast<std::size_t>(i) / 8 == group ? by_the_map : decision::Class::kFree)
          << group << ": " << i;
    }
  };
  for (std::size_t group = 0; group < window::kGroupsPerTile; ++group) {
    window::TileRuledOut ruled_out{};
    ruled_out[group].fill(decision::kBuilding + decision::kIntermediate);
    fusion->rule_out(window::slot_of({0, 0}), ruled_out);
    expect_named({0, 0}, group, decision::Class::kDrivable);
    ruled_out[group].fill(decision::kBuilding + decision::kRoad);
    fusion->rule_out(window::slot_of({0, 0}), ruled_out);
    expect_named({0, 0}, group, decision::Class::kNonDrivable);
    fusion->rule_out(window::slot_of({1, 0}), ruled_out);
  }
  fusion->rule_out(window::slot_of({0, 0}), {});
  expect_named({0, 0}, 0, decision::Class::kFree);
  add_slice(slice, at_cell({32, 0}), *fusion);
  fusion->finish(2 * kFrameUs);
  expect_named({1, 0}, window::kGroupsPerTile - 1, decision::Class::kNonDrivable);
}

// Those in the window are listed while there is room, and forgotten when the frame ends.
TEST(WindowFusion, HitsOfAFrameAreListedIfItIsFollowed) {
  constexpr std::size_t kRows = 257;
  constexpr std::size_t kAcross = 128;
  static_assert(kRows * kAcross > placing::HitList::kMost);
  Slice slice;
  slice.draw({400, 400}, std::vector<std::string>(kRows, std::string(kAcross, '#')));
  for (const bool is_followed : {true, false}) {
    const auto fusion = std::make_unique<WindowFusion>(Rules{}, is_followed);
    fusion->follow(at_cell({0, 0}).pose);
    add_slice(slice, at_cell({0, 0}), *fusion);
    EXPECT_EQ(fusion->hits().size(), is_followed ? placing::HitList::kMost : 0U);
    EXPECT_EQ(fusion->hits_left(), is_followed ? kRows * kAcross - placing::HitList::kMost : 0U);
    fusion->finish(kFrameUs);
    EXPECT_TRUE(fusion->hits().empty());
    EXPECT_EQ(fusion->hits_left(), 0U);
  }
}

// However many frames there were before, and in whichever period they ended.
TEST(WindowFusion, AWindowThatIsForgottenGoesOnLikeANewOne) {
  for (std::uint64_t before = 1; before <= 5; ++before) {
    Fusion forgotten;
    Fusion fresh;
    forgotten.follow({0, 0});
    for (std::uint64_t frame = 0; frame < before; ++frame) {
      forgotten.frame(striped_ground(), 5'000'000 + frame * kFrameUs);
    }
    forgotten.forget();
    forgotten.follow({0, 0});
    fresh.follow({0, 0});
    for (std::uint64_t frame = 0; frame < 60; ++frame) {
      const std::uint64_t stamp_us = 5'500'000 + frame * kFrameUs;
      const auto slices = frame % 20 > 16 ? hits_on_stripes() : striped_ground();
      forgotten.frame(slices, stamp_us);
      fresh.frame(slices, stamp_us);
      ASSERT_TRUE(forgotten.classes() == fresh.classes()) << before << " before, frame " << frame;
    }
  }
}

}  // namespace
}  // namespace iog::perception
