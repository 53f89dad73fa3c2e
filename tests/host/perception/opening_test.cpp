// Ground is opened only from below: scenes from the street, as maps.
#include "perception/opening.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "perception/frames.hpp"

namespace iog::perception {
namespace {

using decision::Class;

// A square of 16 by 16 cells, all of which say `what`.
PlacedSlice field(char what) {
  PlacedSlice placed;
  placed.slice.draw({512, 512}, std::vector<std::string>(16, std::string(16, what)));
  return placed;
}

// The same with a thing of 4 by 4 cells in its middle.
PlacedSlice thing(char what, char around) {
  PlacedSlice placed = field(around);
  placed.slice.draw({518, 518}, std::vector<std::string>(4, std::string(4, what)));
  return placed;
}

class OpenedFromBelow : public testing::TestWithParam<bool> {
 protected:
  OpenedFromBelow() { fusion_.follow({0, 0}); }

  void play(const PlacedSlice& slice, int frames) {
    for (int i = 0; i < frames; ++i) {
      fusion_.frame({slice});
    }
  }
  [[nodiscard]] Class in_the_middle() const { return class_at({8, 8}); }
  [[nodiscard]] Class class_at(Cell cell) const { return fusion_.class_at(cell); }

 private:
  Fusion fusion_{Rules{.is_opened_from_below = GetParam()}};
};

// A car drives onto ground that the scanner has looked at from below.
TEST_P(OpenedFromBelow, WhatComesOntoOpenGroundMoves) {
  play(field(','), 50);
  EXPECT_EQ(in_the_middle(), Class::kFree);
  play(thing('T', ','), 1);
  EXPECT_EQ(in_the_middle(), Class::kMoving);
}

// Nor is it forgotten while other cells of the tile are looked at, and this one is not.
TEST_P(OpenedFromBelow, GroundStaysOpenWhileNothingIsSaidOfIt) {
  play(field(','), 50);
  PlacedSlice elsewhere;
  elsewhere.slice.draw({512 + 8, 512 + 24}, {",,,,"});
  play(elsewhere, 2);
  play(thing('T', ','), 1);
  EXPECT_EQ(in_the_middle(), Class::kMoving);
}

// A bonnet: beams pass over it for two seconds, then the next ring hits it.
TEST_P(OpenedFromBelow, WhatBeamsHavePassedOverIsThere) {
  play(field('.'), 50);
  EXPECT_EQ(in_the_middle(), Class::kFree);
  play(thing('T', '.'), 1);
  EXPECT_EQ(in_the_middle(), GetParam() ? Class::kOccupied : Class::kMoving);
}

// A kerb is too low to be something that has come, wherever beams were before.
TEST_P(OpenedFromBelow, WhatIsLowDoesNotMove) {
  play(field(','), 50);
  play(thing('#', ','), 1);
  EXPECT_EQ(in_the_middle(), GetParam() ? Class::kOccupied : Class::kMoving);
}

// One tall hit is enough for what is hit beside it, up to three cells away.
TEST_P(OpenedFromBelow, WhatIsBesideATallHitMovesWithIt) {
  play(field(','), 50);
  PlacedSlice car = thing('#', ',');
  car.slice.set_tall({518 + 3, 518 + 3});
  play(car, 1);
  EXPECT_EQ(in_the_middle(), Class::kMoving);
}

// Where few hits are tall because the ground nearby is asked, too, up to eight cells away.
TEST(OpenedOverGround, WhatIsNearATallHitMovesWithIt) {
  for (const int away : {3, 4, 8, 9}) {
    for (const int within : {kTallWithin, kTallOverGroundWithin}) {
      for (const bool is_across : {false, true}) {
        Fusion fusion{Rules{.is_opened_from_below = true, .tall_within = within}};
        fusion.follow({0, 0});
        PlacedSlice ground;
        ground.slice.draw({504, 504}, std::vector<std::string>(32, std::string(32, ',')));
        for (int i = 0; i < 50; ++i) {
          fusion.frame({ground});
        }
        PlacedSlice walker = ground;
        walker.slice.draw({519, 519}, std::vector<std::string>(3, std::string(3, '#')));
        const int beside = away + 1;  // of the middle: from the border `away`
        walker.slice.draw(is_across ? Cell{520, 520 + beside} : Cell{520 + beside, 520}, {"T"});
        fusion.frame({walker});
        const Cell border = is_across ? Cell{8, 9} : Cell{9, 8};
        EXPECT_EQ(fusion.class_at(border), away <= within ? Class::kMoving : Class::kOccupied)
            << away << " " << within;
      }
    }
  }
}

// A parked car: beams go through its windows, for a second.
TEST_P(OpenedFromBelow, WhatStandsGivesWayToLowBeamsAlone) {
  play(thing('T', ','), 100);
  EXPECT_EQ(in_the_middle(), Class::kStoppedOrUnmapped);
  play(field('.'), 6);
  EXPECT_EQ(in_the_middle(), GetParam() ? Class::kStoppedOrUnmapped : Class::kFree);
  play(field(','), 6);
  EXPECT_EQ(in_the_middle(), Class::kFree);
}

// A LUX on a bumper looks over nothing: where its beams are not low they pass under something or
// over it, and road that it took for an obstacle gives way to them.
TEST(OpenedByLowSensors, WhatIsTakenGivesWayToAll) {
  Fusion fusion{Rules{.is_opened_from_below = true, .looks_over_things = false}};
  fusion.follow({0, 0});
  for (int i = 0; i < 100; ++i) {
    fusion.frame({thing('T', ',')});
  }
  EXPECT_EQ(fusion.class_at({8, 8}), Class::kStoppedOrUnmapped);
  for (int i = 0; i < 6; ++i) {
    fusion.frame({field('.')});
  }
  EXPECT_EQ(fusion.class_at({8, 8}), Class::kFree);
  fusion.frame({thing('T', '.')});
  EXPECT_NE(fusion.class_at({8, 8}), Class::kMoving);
}

// The ground under what stands is not remembered as open from before it came.
TEST_P(OpenedFromBelow, WhatHasStoodClosesItsGround) {
  play(field(','), 50);
  play(thing('T', ','), 100);
  EXPECT_EQ(in_the_middle(), Class::kStoppedOrUnmapped);
  play(field('.'), 100);
  play(thing('T', '.'), 1);
  EXPECT_NE(in_the_middle(), GetParam() ? Class::kMoving : Class::kUnknown);
}

// A low beam frees one cell among those that others free: what surrounds it is not known as ground,
// so it is neither dense nor open, and a tall thing that is hit there has not come. Row by row, so
// that no row of a tile is left out.
TEST_P(OpenedFromBelow, OneLowBeamMakesNoGroundOfWhatIsAroundIt) {
  PlacedSlice ground;
  PlacedSlice hit;
  std::vector<std::string> rows(32, std::string(8, '.'));
  for (std::size_t y = 4; y < 28; ++y) {
    rows[y][4] = ',';
  }
  ground.slice.draw({512, 512}, rows);
  for (std::int32_t y = 4; y < 28; ++y) {
    hit.slice.draw({516, 512 + y}, {"T"});
  }
  play(ground, 50);
  play(hit, 1);
  for (std::int32_t y = 4; y < 28; ++y) {
    EXPECT_EQ(class_at({4, y}), GetParam() ? Class::kOccupied : Class::kMoving) << y;
  }
}

INSTANTIATE_TEST_SUITE_P(Rule, OpenedFromBelow, testing::Bool(),
                         [](const auto& rule) { return rule.param ? "Applies" : "DoesNotApply"; });

}  // namespace
}  // namespace iog::perception
