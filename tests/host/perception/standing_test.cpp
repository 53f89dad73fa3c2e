// What of that which stands is met, what is crossed, and when the poses are contradicted.
#include "perception/standing.hpp"

#include <cstdlib>
#include <gtest/gtest.h>
#include <memory>

#include "placing/evidence_bits.hpp"

namespace iog::perception {
namespace {

struct Frame {
  void stand(int x, int y) {
    tile->found.stands.at(static_cast<std::size_t>(y)) |= std::uint32_t{1} << x;
  }
  void index(int x, int y, std::int8_t value) {
    const int place = y * static_cast<int>(geometry::kTileSide) + x;
    indexes.at(static_cast<std::size_t>(place)) = value;
  }
  [[nodiscard]] StandingCounts counts(bool from_below = false, int cell_mm = 100) const {
    const placing::EvidenceBits bits = placing::bits_of(indexes);
    return standing_counts(*tile, bits.hit, from_below ? bits.from_below : bits.free,
                           around_with(cell_mm));
  }

  std::unique_ptr<window::Tile> tile = std::make_unique<window::Tile>();
  placing::FrameEvidence::TileIndexes indexes{};
};

// 0.2 m, rounded up to cells.
TEST(Standing, IsMetIfSomethingIsHitWithinTwoCells) {
  for (int dx = -3; dx <= 3; ++dx) {
    for (int dy = -3; dy <= 3; ++dy) {
      Frame frame;
      frame.stand(16, 9);
      frame.index(16, 9, -5);
      frame.index(16 + dx, 9 + dy, 4);
      for (const int cell_mm : {100, 200, 500}) {
        const int reach = cell_mm == 100 ? 2 : 1;
        const bool is_near = std::abs(dx) <= reach && std::abs(dy) <= reach;
        EXPECT_EQ(frame.counts(false, cell_mm), (is_near ? StandingCounts{.met = 1, .crossed = 0}
                                                         : StandingCounts{.met = 0, .crossed = 1}))
            << dx << " " << dy;
      }
    }
  }
}

// Over a bonnet beams go as long as it stands there.
TEST(Standing, IsCrossedFromBelowAloneWhereThatIsAsked) {
  Frame frame;
  frame.stand(16, 9);
  frame.index(16, 9, placing::byte_of(-5, false));
  EXPECT_EQ(frame.counts(true), StandingCounts{});
  EXPECT_EQ(frame.counts(false).crossed, 1U);
  frame.index(16, 9, placing::byte_of(-5, true));
  EXPECT_EQ(frame.counts(true).crossed, 1U);
  EXPECT_EQ(frame.counts(false).crossed, 1U);
}

TEST(Standing, OfWhichNothingIsSaidIsNeither) {
  Frame frame;
  frame.stand(10, 10);
  frame.index(11, 10, -5);
  EXPECT_EQ(frame.counts(), StandingCounts{});
  Frame nothing_stands;
  nothing_stands.index(10, 10, -5);
  nothing_stands.index(20, 10, 5);
  EXPECT_EQ(nothing_stands.counts(), StandingCounts{});
}

// Whoever is at the border may have been hit beyond it.
TEST(Standing, AtTheBorderOfATileIsLeftOut) {
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      Frame frame;
      frame.stand(x, y);
      frame.index(x, y, -128);
      const bool is_inside = x >= 2 && x < 30 && y >= 2 && y < 30;
      EXPECT_EQ(frame.counts().crossed, is_inside ? 1U : 0U) << x << " " << y;
    }
  }
}

// Frames until the poses are contradicted, at most 100.
int frames_until_met(const StandingCounts& frame, bool has_moved = true,
                     std::uint32_t cell_mm = 100) {
  Contradiction contradiction;
  int frames = 0;
  while (!contradiction.is_met(has_moved, cell_mm) && frames < 100) {
    contradiction.add(frame);
    ++frames;
  }
  return frames;
}

TEST(Contradiction, IsAShareOfASixteenthOfFiveHundredCells) {
  EXPECT_EQ(frames_until_met({.met = 940, .crossed = 60}), 100) << "6 %";
  EXPECT_EQ(frames_until_met({.met = 930, .crossed = 70}), 1) << "7 %";
  EXPECT_LE(frames_until_met({.met = 0, .crossed = 70}), 20);
  EXPECT_EQ(frames_until_met({.met = 0, .crossed = 60}), 100) << "fewer than 500 in eight frames";
  EXPECT_EQ(frames_until_met({}), 100);
}

// The same edges in cells twice as large.
TEST(Contradiction, NeedsFewerOfLargerCells) {
  EXPECT_EQ(frames_until_met({.met = 230, .crossed = 20}, true, 200), 1);
  EXPECT_EQ(frames_until_met({.met = 0, .crossed = 30}, true, 200), 100);
  EXPECT_LE(frames_until_met({.met = 0, .crossed = 35}, true, 200), 20);
  EXPECT_LE(frames_until_met({.met = 9, .crossed = 3}, false, 200), 50);
}

// As poses were that said from the first on that the car stands, while it drove (city, 10 s).
TEST(Contradiction, IsAnEighthOfFewCellsWhileTheCarHasNeverMoved) {
  constexpr StandingCounts kDriven{.met = 18, .crossed = 6};
  EXPECT_EQ(frames_until_met(kDriven), 100);
  EXPECT_LE(frames_until_met(kDriven, false), 50);
  EXPECT_EQ(frames_until_met({.met = 35, .crossed = 5}, false), 100) << "an eighth";
}

// It stands among walls, and cars that stood beside it drive off.
TEST(Contradiction, IsNoneForACarThatIsParked) {
  Contradiction contradiction;
  for (int frame = 0; frame < 1'000; ++frame) {
    const bool drives_off = frame % 100 < 12;
    contradiction.add({.met = 150, .crossed = drives_off ? 8U : 0U});
    ASSERT_FALSE(contradiction.is_met(false)) << frame;
  }
}

TEST(Contradiction, BeginsWithinHalfASecondAndIsOverWhenItIsForgotten) {
  Contradiction contradiction;
  for (int frame = 0; frame < 100; ++frame) {
    contradiction.add({.met = 400, .crossed = 4});
    ASSERT_FALSE(contradiction.is_met(true));
  }
  int frames = 0;
  for (; !contradiction.is_met(true); ++frames) {
    contradiction.add({.met = 300, .crossed = 60});
  }
  EXPECT_LE(frames, 12) << "of 40 ms";
  contradiction.clear();
  EXPECT_FALSE(contradiction.is_met(true));
}

}  // namespace
}  // namespace iog::perception
