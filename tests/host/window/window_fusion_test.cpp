// The window in time against plain loops, and laws: order, refresh, budget, forgetting.
#include "window/window_fusion.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <utility>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "window/plain_fusion.hpp"
#include "window/slice.hpp"

namespace iog::window {
namespace {

using geometry::Cell;
using tests::GroundCell;
using tests::PlacedSlice;
using tests::Slice;
using ClassBytes = std::array<std::int8_t, geometry::kTileCells>;

constexpr std::uint64_t kFrameUs = 40'000;

Placement at_cell(Cell vehicle) {
  return tests::placed(vehicle.x * geometry::kCellMm, vehicle.y * geometry::kCellMm);
}

decision::Class class_of(std::int8_t byte) { return static_cast<decision::Class>(byte / 8); }

// A window that is given whole frames.
class Fusion {
 public:
  explicit Fusion(const Rules& rules = {}) : fusion_(std::make_unique<WindowFusion>(rules)) {}

  FrameCounts frame(const std::vector<PlacedSlice>& slices, std::uint64_t stamp_us) {
    for (const auto& [slice, vehicle] : slices) {
      fusion_->add(slice, at_cell(vehicle));
    }
    return fusion_->finish(stamp_us);
  }
  // A frame every 40 ms.
  FrameCounts frame(const std::vector<PlacedSlice>& slices) {
    now_us_ += kFrameUs;
    return frame(slices, now_us_);
  }
  void follow(Cell vehicle) { fusion_->follow(at_cell(vehicle).pose); }
  void forget() { fusion_->forget(); }

  [[nodiscard]] WindowView view() const { return fusion_->view(); }

  [[nodiscard]] decision::Class class_at(Cell cell) const {
    const TileNumber tile{numeric::div_floor(cell.x, kTileSide),
                          numeric::div_floor(cell.y, kTileSide)};
    ClassBytes bytes;
    view().copy_classes(slot_of(tile), bytes);
    const std::int32_t in_tile =
        (cell.y - tile.b * kTileSide) * kTileSide + cell.x - tile.a * kTileSide;
    return class_of(bytes[static_cast<std::size_t>(in_tile)]);
  }

  [[nodiscard]] std::vector<ClassBytes> classes() const {
    std::vector<ClassBytes> tiles(kSlotCount);
    for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
      view().copy_classes(slot, tiles[slot]);
    }
    return tiles;
  }
  [[nodiscard]] std::size_t known_tiles() const {
    std::size_t known = 0;
    for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
      known += view().is_known(slot) ? 1U : 0U;
    }
    return known;
  }

 private:
  std::unique_ptr<WindowFusion> fusion_;
  std::uint64_t now_us_ = 0;
};

// A street in cells of the local frame: a wall that flickers, and a block that comes along.
struct Street {
  Cell origin;

  // What a beam finds in a cell: above 0 a hit.
  [[nodiscard]] int look(Cell cell, int frame, tests::Random& random) const {
    const Cell at{cell.x - origin.x, cell.y - origin.y};
    const Cell block{5 * frame - 30, -14};
    const bool is_wall = at.y >= 12 && at.y <= 13 && at.x % 17 != 0;
    const bool is_block =
        at.x >= block.x && at.x < block.x + 6 && at.y >= block.y && at.y < block.y + 4;
    if (is_wall || is_block) {
      return random.one_in(4) ? -14 : 2;
    }
    return at.y > 13 || random.one_in(9) ? 0 : -14;
  }
};

struct DrivenFrame {
  Cell vehicle;
  std::vector<PlacedSlice> slices;
  std::uint64_t stamp_us = 0;
};

// What a vehicle sees within three metres: three slices a frame, each from a cell further on.
// Frames come every 40 ms, once nothing is placed, and once there is a gap.
std::vector<DrivenFrame> drive(Cell start, int frames) {
  constexpr std::int32_t kReach = 30;
  tests::Random random(77);
  const Street street{start};
  std::vector<DrivenFrame> drive;
  std::uint64_t stamp_us = 1'000'000'000'000;
  for (int number = 0; number < frames; ++number) {
    const int more_us = number == 20 ? 700'123 : number % 7;
    stamp_us += number == 5 ? 0 : kFrameUs + static_cast<std::uint64_t>(more_us);
    DrivenFrame frame{.vehicle = {start.x + 4 * number, start.y + number % 3},
                      .slices = {},
                      .stamp_us = stamp_us};
    if (number >= frames * 2 / 3 && number < frames * 2 / 3 + 3) {
      frame.vehicle.x += 700;  // beyond all that was seen, and back
    }
    for (std::int32_t i = 0; i < 3 && number != 9; ++i) {
      frame.slices.push_back({.slice = {}, .vehicle = {frame.vehicle.x + i, frame.vehicle.y}});
    }
    for (std::int32_t i = 0; i < 4 * kReach * kReach && !frame.slices.empty(); ++i) {
      const Cell at{i % (2 * kReach) - kReach, i / (2 * kReach) - kReach};
      const Cell cell{frame.vehicle.x + at.x, frame.vehicle.y + at.y};
      PlacedSlice& seen_by = frame.slices[random.below(3)];
      seen_by.slice.set({geometry::kOriginCell + cell.x - seen_by.vehicle.x,
                         geometry::kOriginCell + cell.y - seen_by.vehicle.y},
                        street.look(cell, number, random));
    }
    drive.push_back(std::move(frame));
  }
  return drive;
}

constexpr Cell kStart{-3'000'017, 2'000'039};

TEST(WindowFusion, ADriveIsWhatPlainLoopsMakeOfIt) {
  const auto fusion = std::make_unique<WindowFusion>();
  tests::PlainFusion plain;
  int moving = 0;
  int standing = 0;
  for (const DrivenFrame& frame : drive(kStart, tests::effort(48, 14))) {
    fusion->follow(at_cell(frame.vehicle).pose);
    plain.follow(frame.vehicle);
    for (const auto& [slice, vehicle] : frame.slices) {
      fusion->add(slice, at_cell(vehicle));
    }
    fusion->finish(frame.stamp_us);
    plain.frame(frame.slices, frame.stamp_us);
    std::size_t known = 0;
    for (const auto& [number, tile] : plain.tiles()) {
      const std::size_t slot = slot_of({number.second, number.first});
      ClassBytes bytes;
      ASSERT_TRUE(fusion->view().copy_classes(slot, bytes));
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        ASSERT_EQ(int{bytes[i]}, int{tile.groups[i / 8].masses.decided[i % 8]}) << frame.stamp_us;
        moving += class_of(bytes[i]) == decision::Class::kMoving ? 1 : 0;
        standing += class_of(bytes[i]) == decision::Class::kStoppedOrUnmapped ? 1 : 0;
      }
      ASSERT_EQ(fusion->view().age_ms(slot), plain.now_ms() - tile.refreshed_ms);
      ++known;
    }
    for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
      known -= fusion->view().is_known(slot) ? 1U : 0U;
    }
    ASSERT_EQ(known, 0U);
  }
  EXPECT_GT(moving, tests::effort(100, 10));
  EXPECT_GT(standing, tests::effort(100, 0) - 1);
}

TEST(WindowFusion, NoOrderOfSlicesShows) {
  Fusion forward;
  Fusion backward;
  for (DrivenFrame& frame : drive(kStart, 12)) {
    forward.follow(frame.vehicle);
    backward.follow(frame.vehicle);
    const FrameCounts counts = forward.frame(frame.slices, frame.stamp_us);
    std::ranges::reverse(frame.slices);
    ASSERT_EQ(backward.frame(frame.slices, frame.stamp_us), counts);
    ASSERT_TRUE(forward.classes() == backward.classes());
  }
}

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
    for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
      ASSERT_TRUE(!fusion.view().is_known(slot) || fusion.view().age_ms(slot) <= 7 * 40);
    }
  }
  EXPECT_EQ(refreshed, 144U * 10);
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

TEST(WindowFusion, HitsAreFusedWhateverTheBudget) {
  for (const std::uint32_t budget : {0U, 1U, 10U, 13U, 100U}) {
    Fusion fusion({.group_budget = budget});
    fusion.follow({0, 0});
    std::vector<PlacedSlice> slices = free_cells(20);
    for (int i = 0; i < 10; ++i) {
      slices[0].slice.set({300 + i * 32, 310}, 2);
    }
    const FrameCounts counts = fusion.frame(slices);
    const std::uint32_t others = budget < 10 ? 0 : std::min<std::uint32_t>(budget - 10, 20);
    EXPECT_EQ(counts.groups_fused, 10 + others);
    EXPECT_EQ(counts.groups_left, 20 - others);
    for (int i = 0; i < 10; ++i) {
      EXPECT_EQ(fusion.class_at({300 + i * 32 - 512, 310 - 512}), decision::Class::kOccupied);
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
  EXPECT_TRUE(fusion.classes() == std::vector<ClassBytes>(kSlotCount));
  EXPECT_EQ(fusion.frame(free_cells(1)).slices_outside, 1U);
  EXPECT_EQ(fusion.known_tiles(), 0U);
  fusion.follow({0, 0});
  EXPECT_EQ(fusion.frame(free_cells(1)).slices, 1U);
  EXPECT_EQ(fusion.known_tiles(), 1U);
}

// Slices before and after: of the frame in which the window is forgotten only those after count.
TEST(WindowFusion, EvidenceOfTheFrameIsForgottenToo) {
  const auto fusion = std::make_unique<WindowFusion>();
  const Placement at = at_cell({0, 0});
  fusion->follow(at.pose);
  fusion->add(free_cells(144)[0].slice, at);
  fusion->forget();
  fusion->follow(at.pose);
  Slice one;
  one.set({512, 512}, 2);
  fusion->add(one, at);
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

}  // namespace
}  // namespace iog::window
