// Several cores make of a frame what one makes of it, in whatever order they do it and whichever of
// them is lost.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "fakes/cores_in_turn.hpp"
#include "fakes/effort.hpp"
#include "perception/frames.hpp"

namespace iog::perception {
namespace {

// Slices of a frame around a vehicle that turns, up to the borders of the window.
class PartOfFrame {
 public:
  PartOfFrame(Cell vehicle, int frame, tests::Random& random) {
    for (std::uint8_t number = 0; number < 3; ++number) {
      Slice slice;
      slice.draw({512 - kOpen, 512 - kOpen},
                 std::vector<std::string>(2 * kOpen, std::string(2 * kOpen, ',')));
      for (int i = 0; i < 3'000; ++i) {
        const int reach = i < 2'500 ? 60 : 512;
        const Cell cell{512 + random.between(-reach, reach - 1),
                        512 + random.between(-reach, reach - 1)};
        if (std::max(std::abs(cell.x - 512), std::abs(cell.y - 512)) < kOpen &&
            !random.one_in(20)) {
          continue;
        }
        slice.set(cell, random.one_in(4) ? random.between(1, 9) : random.between(-20, -1));
        if (random.one_in(2)) {
          slice.set_low(cell);
        }
      }
      tests::hand_over(slice, *cells_.emplace_back(std::make_unique<placing::SliceCells>()));
      placed_.push_back({.cells = cells_.back().get(),
                         .at = tests::placed(100 * vehicle.x + 31 * number, 100 * vehicle.y,
                                             7.0 * frame + number),
                         .number = number});
    }
  }
  [[nodiscard]] std::span<const placing::PlacedCells> slices() const { return placed_; }

 private:
  static constexpr int kOpen = 24;  // cells around the vehicle where ground is free

  std::vector<std::unique_ptr<placing::SliceCells>> cells_;
  std::vector<placing::PlacedCells> placed_;
};

class Cores : public testing::TestWithParam<std::tuple<std::size_t, bool>> {
 protected:
  [[nodiscard]] static bool are_lost() { return std::get<1>(GetParam()); }

  tests::CoresInTurn cores_{std::get<0>(GetParam()), are_lost(), 41};
  work::Crew crew_{cores_};
};

TEST_P(Cores, JoinTheEvidenceThatOneJoins) {
  tests::Random random(42);
  const auto by_one = std::make_unique<placing::FrameEvidence>();
  const auto shared = std::make_unique<placing::FrameEvidence>();
  for (int frame = 0; frame < tests::effort(4, 2); ++frame) {
    const Cell vehicle{random.between(-9'999, 9'999), random.between(-9'999, 9'999)};
    const window::Extent extent = frame % 2 == 0 ? window::Extent{} : window::Extent{14, 5};
    const window::Area area = window::Area::around(vehicle, extent);
    for (int time = 0; time < 2; ++time) {  // the second finds evidence of the first
      const PartOfFrame part(vehicle, frame, random);
      by_one->add(part.slices(), area);
      shared->add(part.slices(), area, crew_);
    }
    std::size_t tall = 0;
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      ASSERT_EQ(shared->is_touched(slot), by_one->is_touched(slot)) << slot;
      ASSERT_EQ(shared->has_hit(slot), by_one->has_hit(slot)) << slot;
      ASSERT_TRUE(shared->tile(slot) == by_one->tile(slot)) << slot;
      if (by_one->is_touched(slot)) {
        ASSERT_TRUE(shared->tall(slot) == by_one->tall(slot)) << slot;
        tall += window::is_empty(by_one->tall(slot)) ? 0U : 1U;
        ASSERT_TRUE(area.contains(area.tile_at(slot)));
      }
    }
    EXPECT_GT(tall, extent.tile_count() / 10);
    by_one->clear();
    shared->clear();
  }
  EXPECT_EQ(cores_.redone() > 0, are_lost());
}

template <typename T>
bool are_same_bytes(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

// All that two tiles say, of which something is known.
void expect_same(const window::Tile& one, const window::Tile& other, std::size_t slot) {
  ASSERT_EQ(one.decided, other.decided) << slot;
  ASSERT_EQ(one.aged_at, other.aged_at) << slot;
  ASSERT_EQ(one.evidence_at, other.evidence_at) << slot;
  ASSERT_EQ(one.is_free_alone, other.is_free_alone) << slot;
  ASSERT_EQ(one.from_below, other.from_below) << slot;
  ASSERT_TRUE(are_same_bytes(one.found, other.found)) << slot;
  ASSERT_TRUE(are_same_bytes(one.ground, other.ground)) << slot;
  for (std::size_t group = 0; group < window::kGroupsPerTile; ++group) {
    ASSERT_TRUE(!one.is_known(group) || one.free[group] == other.free[group]) << slot;
    ASSERT_TRUE(!one.is_known(group) || one.is_free_alone[group] ||
                are_same_bytes(one.taken[group], other.taken[group]))
        << slot;
  }
}

// Over budget, too, where what is left depends on the order of slots.
TEST_P(Cores, KeepTheWindowThatOneKeeps) {
  for (const std::uint32_t budget : {kGroupBudget, std::uint32_t{900}}) {
    tests::Random random(43);
    const Rules rules{.is_opened_from_below = true, .group_budget = budget};
    const auto by_one = std::make_unique<WindowFusion>(rules);
    const auto shared = std::make_unique<WindowFusion>(rules);
    std::uint32_t left = 0;
    int open = 0;
    for (int number = 0; number < tests::effort(12, 6); ++number) {
      const Cell vehicle{-7'000 + 11 * number, 4'000};
      by_one->follow(at_cell(vehicle).pose);
      shared->follow(at_cell(vehicle).pose);
      const PartOfFrame frame(vehicle, number, random);
      by_one->add(frame.slices());
      shared->add(frame.slices(), crew_);
      const std::uint64_t stamp_us = 1'000'000 + static_cast<std::uint64_t>(number) * kFrameUs;
      const FrameCounts counts = by_one->finish(stamp_us);
      ASSERT_EQ(shared->finish(stamp_us, crew_), counts);
      left += counts.groups_left;
      for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
        ASSERT_EQ(shared->view().is_known(slot), by_one->view().is_known(slot)) << slot;
        if (by_one->view().is_known(slot)) {
          ASSERT_EQ(shared->view().age_frames(slot), by_one->view().age_frames(slot)) << slot;
          expect_same(shared->view().tile(slot), by_one->view().tile(slot), slot);
          open += window::is_empty(by_one->view().tile(slot).ground.open) ? 0 : 1;
        }
      }
    }
    EXPECT_EQ(left > 0, budget == 900);
    EXPECT_GT(open, 0);
  }
  EXPECT_EQ(cores_.redone() > 0, are_lost());
}

// Each tile of a slice is copied or left by any core, and by core 0 again.
TEST_P(Cores, CopyTheSliceThatOneSets) {
  tests::Random random(44);
  const auto by_one = std::make_unique<placing::SliceCells>();
  const auto shared = std::make_unique<placing::SliceCells>();
  for (int time = 0; time < 4; ++time) {
    Slice slice;
    for (int i = 0; i < 300; ++i) {
      const Cell cell{random.between(0, 1023), random.between(0, 1023)};
      slice.set(cell, random.one_in(5) ? 3 : -14);
      if (random.one_in(3)) {
        slice.set_tall(cell);
      }
    }
    by_one->clear();
    tests::hand_over(slice, *by_one);
    std::vector<std::array<std::int8_t, geometry::kTileCells>> tiles(geometry::kTileCount);
    std::vector<window::Plane> tall(geometry::kTileCount);
    slice.release([&](std::size_t tile, auto indexes, const window::Plane& low_and_tall) {
      std::ranges::copy(indexes, tiles[tile].begin());
      tall[tile] = low_and_tall;
    });
    shared->begin();
    crew_.share(geometry::kTileCount, [&](std::size_t tile, std::size_t /*core*/) {
      if (std::ranges::any_of(tiles[tile], [](std::int8_t index) { return index != 0; })) {
        shared->copy(tile, tiles[tile], tall[tile]);
      } else {
        shared->leave(tile);
      }
    });
    shared->note_all();
    EXPECT_EQ(shared->extent().low, by_one->extent().low);
    EXPECT_EQ(shared->extent().high, by_one->extent().high);
    EXPECT_TRUE(std::ranges::equal(shared->hit_tiles(), by_one->hit_tiles()));
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      const Cell at{static_cast<std::int32_t>(tile % geometry::kTilesPerSide),
                    static_cast<std::int32_t>(tile / geometry::kTilesPerSide)};
      ASSERT_EQ(shared->is_known(tile), by_one->is_known(tile)) << tile;
      ASSERT_TRUE(std::ranges::equal(shared->cells(at), by_one->cells(at))) << tile;
    }
    for (int i = 0; i < 2'000; ++i) {
      const Cell low{random.between(-20, 1040), random.between(-20, 1040)};
      const Cell high{low.x + random.between(0, 12), low.y + random.between(0, 12)};
      ASSERT_EQ(shared->is_known_near(low, high), by_one->is_known_near(low, high));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(TwoToFour, Cores,
                         testing::Combine(testing::Values(2U, 4U), testing::Bool()));

}  // namespace
}  // namespace iog::perception
