// A drive in the window against plain loops, and against itself with its slices the other way
// round.
#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>
#include <utility>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "perception/frames.hpp"
#include "perception/kept_versions.hpp"
#include "perception/plain_fusion.hpp"
#include "perception/window_fusion.hpp"

namespace iog::perception {
namespace {

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

constexpr std::int32_t kReach = 30;

// What a vehicle sees within three metres: three slices a frame, each from a cell further on.
// Frames come every 40 ms, once nothing is placed, and once there is a gap.
std::vector<DrivenFrame> drive(Cell start, int frames, std::int32_t reach = kReach) {
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
    for (std::int32_t i = 0; i < 4 * reach * reach && !frame.slices.empty(); ++i) {
      const Cell at{i % (2 * reach) - reach, i / (2 * reach) - reach};
      const Cell cell{frame.vehicle.x + at.x, frame.vehicle.y + at.y};
      PlacedSlice& seen_by = frame.slices[random.below(3)];
      const Cell in_grid{geometry::kOriginCell + cell.x - seen_by.vehicle.x,
                         geometry::kOriginCell + cell.y - seen_by.vehicle.y};
      seen_by.slice.set(in_grid, street.look(cell, number, random));
      if (!random.one_in(3)) {
        seen_by.slice.set_low(in_grid);
      }
      if (random.one_in(8)) {
        seen_by.slice.set_tall(in_grid);
      }
    }
    drive.push_back(std::move(frame));
  }
  return drive;
}

constexpr Cell kStart{-3'000'017, 2'000'039};

// How far away a tall hit is at most beside which something can arrive; 0: ground is opened by all;
// below 0: by low beams of sensors that do not look over things.
class DriveIn : public testing::TestWithParam<int> {};

// The drive is in cells, so larger cells are a larger world, in which the rules look as far in
// metres.
void expect_what_plain_loops_make(int within, std::uint16_t cell_mm, const tests::Looks& looks,
                                  window::Extent extent = {}, std::int32_t reach = kReach) {
  const bool is_opened_from_below = within != 0;
  const bool looks_over_things = within >= 0;
  const int tall_within = is_opened_from_below ? std::abs(within) : kTallWithin;
  const auto fusion =
      std::make_unique<WindowFusion>(Rules{.is_opened_from_below = is_opened_from_below,
                                           .looks_over_things = looks_over_things,
                                           .tall_within = tall_within,
                                           .around = around_with(cell_mm),
                                           .extent = extent},
                                     false, cell_mm);
  tests::PlainFusion plain(is_opened_from_below, tall_within, looks_over_things, looks, extent);
  KeptVersions versions;
  int moving = 0;
  int standing = 0;
  for (const DrivenFrame& frame : drive(kStart, tests::effort(48, 14), reach)) {
    fusion->follow(at_cell(frame.vehicle, cell_mm).pose);
    plain.follow(frame.vehicle);
    for (const auto& [slice, vehicle] : frame.slices) {
      add_slice(slice, at_cell(vehicle, cell_mm), *fusion);
    }
    fusion->finish(frame.stamp_us);
    plain.frame(frame.slices, frame.stamp_us);
    versions.look(fusion->view());
    std::size_t known = 0;
    for (const auto& [number, tile] : plain.tiles()) {
      const std::size_t slot = window::slot_of({number.second, number.first});
      ClassBytes bytes;
      const bool is_classified = fusion->view().copy_classes(slot, bytes);
      ASSERT_EQ(is_classified, std::ranges::any_of(bytes, [](auto byte) { return byte != 0; }));
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        ASSERT_EQ(int{bytes[i]}, int{tile.groups[i / 8].decided[i % 8]}) << frame.stamp_us;
        moving += class_of(bytes[i]) == decision::Class::kMoving ? 1 : 0;
        standing += class_of(bytes[i]) == decision::Class::kStoppedOrUnmapped ? 1 : 0;
      }
      ASSERT_EQ(fusion->view().age_frames(slot), plain.frames() - tile.refreshed_frame);
      ++known;
    }
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      known -= fusion->view().is_known(slot) ? 1U : 0U;
    }
    ASSERT_EQ(known, 0U);
  }
  EXPECT_GT(moving, tests::effort(100, 10));
  // In a short drive, beams reach each tile of a small window in each frame.
  EXPECT_GT(versions.stayed(), extent == window::Extent{} ? 0 : tests::effort(1, 0) - 1);
  EXPECT_GT(standing, tests::effort(100, 0) - 1);
}

TEST_P(DriveIn, AWindowIsWhatPlainLoopsMakeOfIt) {
  expect_what_plain_loops_make(GetParam(), 100, {.beside = 1, .gaps = 2, .open = 3});
}

INSTANTIATE_TEST_SUITE_P(TallWithin, DriveIn, testing::Values(0, 3, 8, -3));

// 0.1, 0.2 and 0.3 m, and 0.3 and 0.8 m to a tall hit, rounded up to cells.
TEST(DriveInLargerCells, AWindowIsWhatPlainLoopsMakeOfIt) {
  expect_what_plain_loops_make(0, 200, {.beside = 1, .gaps = 1, .open = 2});
  expect_what_plain_loops_make(2, 200, {.beside = 1, .gaps = 1, .open = 2});
  expect_what_plain_loops_make(4, 200, {.beside = 1, .gaps = 1, .open = 2});
  expect_what_plain_loops_make(0, 500, {.beside = 1, .gaps = 1, .open = 1});
}

// The car sees farther than to the sides of these windows.
TEST(DriveInRectangles, AWindowIsWhatPlainLoopsMakeOfIt) {
  constexpr tests::Looks kLooks{.beside = 1, .gaps = 2, .open = 3};
  expect_what_plain_loops_make(0, 100, kLooks, {.columns = 4, .rows = 5}, 70);
  expect_what_plain_loops_make(3, 100, kLooks, {.columns = 7, .rows = 4}, 70);
}

TEST(WindowFusion, NoOrderOfSlicesShows) {
  Fusion forward(Rules{.is_opened_from_below = true});
  Fusion backward(Rules{.is_opened_from_below = true});
  for (DrivenFrame& frame : drive(kStart, 12)) {
    forward.follow(frame.vehicle);
    backward.follow(frame.vehicle);
    const FrameCounts counts = forward.frame(frame.slices, frame.stamp_us);
    std::ranges::reverse(frame.slices);
    ASSERT_EQ(backward.frame(frame.slices, frame.stamp_us), counts);
    ASSERT_TRUE(forward.classes() == backward.classes());
  }
}

}  // namespace
}  // namespace iog::perception
