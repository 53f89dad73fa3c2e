// A cell is asked for what moves alone, and is told what all tracks together say.
#include "objects/moving_boxes.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>

#include "fakes/random.hpp"

namespace iog::objects {
namespace {

using iog::tests::Random;

void begin(Track& track, std::uint32_t id, Random& random) {
  const Box box{.at = {random.between(-20'000, 20'000), random.between(-20'000, 20'000)},
                .along = {14'189, 8'192},  // 30 degrees
                .sides = {{{random.between(-3'000, 0), random.between(0, 3'000)},
                           {random.between(-1'000, 0), random.between(0, 1'000)}}}};
  track.begin(id, box, 1);
  track.state = random.one_in(3) ? State::kMoves : State::kStands;
}

TEST(MovingBoxes, HoldWhatIsNearABoxOfATrackThatMoves) {
  Random random(9);
  const auto tracks = std::make_unique<Tracks>();
  for (std::uint32_t slot = 0; slot < 40; ++slot) {
    begin((*tracks)[slot * 5], slot + 1, random);
  }
  MovingBoxes boxes;
  boxes.list(*tracks);
  int held = 0;
  for (int i = 0; i < 10'000; ++i) {
    const geometry::Cell first{random.between(-250, 250), random.between(-250, 250)};
    const auto asked = static_cast<std::uint32_t>(random.between(1, 0xFF));
    std::uint32_t expected = 0;
    for (std::int32_t x = 0; x < 8; ++x) {
      const bool is_held = std::ranges::any_of(*tracks, [&](const Track& track) {
        return track.is_there() && track.state == State::kMoves &&
               track.box().outside(centre_of({first.x + x, first.y})) <= kTailMm;
      });
      expected |= (is_held ? 1U : 0U) << x;
    }
    ASSERT_EQ(boxes.hold(first, asked), expected & asked) << i;
    held += expected == 0 ? 0 : 1;
  }
  EXPECT_GT(held, 50);
  boxes.clear();
  const Point middle = (*tracks)[0].box().at;
  EXPECT_EQ(boxes.hold({middle.x_mm / geometry::kCellMm, middle.y_mm / geometry::kCellMm}, 1), 0U);
}

}  // namespace
}  // namespace iog::objects
