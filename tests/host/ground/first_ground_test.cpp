// The first ground of a sector: near objects that hide the road are none.
#include <array>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/walked_turns.hpp"
#include "ground/surface_walk.hpp"

namespace iog::ground {
namespace {

using tests::kShort;
using tests::lows_of;
using tests::Return;
using tests::surface_after;
using tests::Turn;

// A unit on a high roof beside a parked car, or a van: it hides the road, and its side and bonnet,
// or its bonnet and roof, are the first returns. They are no ground, neither in the first turn nor
// while it stays there.
TEST(FirstGround, ACarOrVanBesideAHighUnitIsNotTheFirstGround) {
  using Low = std::array<std::int32_t, 2>;
  for (const auto& lows : {std::vector<Low>{{3, 420}, {4, 900}, {5, 1'400}, {9, 700}},
                           {{1, 1'050}, {2, 1'100}, {3, 1'130}, {4, 1'900}}}) {
    Turn turn;
    for (std::int32_t sector = 40; sector < 90; ++sector) {
      for (const auto& [bin, z_mm] : lows) {
        turn.push_back({sector, bin * 1024, z_mm});
      }
    }
    SurfaceWalk walk;
    Surface surface;
    for (int turns = 0; turns < 20; ++turns) {
      walk.close_turn(kShort, lows_of(kShort, turn), surface);
      for (const Return& its : turn) {
        ASSERT_EQ(
            surface.height_over(kShort, 60, static_cast<std::uint32_t>(its.along_mm), its.z_mm),
            its.z_mm);
      }
    }
  }
}

// The side of a car that the unit drives up to is as low as a first ground may be, but not over the
// road that the last turn saw in most of the three sectors. With a mount that is 200 mm too low,
// where only cars were seen the road is ground as soon as it comes into view.
TEST(FirstGround, ADoorOverTheLastTurnsRoadIsNotTheFirstGround) {
  for (const std::int32_t road_mm : {-140, 200}) {
    const auto road = [&](Turn& turn, std::int32_t from, std::int32_t to) {
      for (std::int32_t sector = from; sector < to; ++sector) {
        for (std::int32_t bin = 4; bin < 30; ++bin) {
          turn.push_back({sector, bin * 1024, road_mm});
        }
      }
    };
    Turn turn;
    road(turn, 0, 110);
    road(turn, 130, 256);
    for (std::int32_t sector = 110; sector < 130; ++sector) {
      turn.push_back({sector, 6 * 1024, road_mm + 420});
    }
    SurfaceWalk walk;
    Surface surface;
    for (int turns = 0; turns < 3; ++turns) {
      walk.close_turn(kShort, lows_of(kShort, turn), surface);
    }
    EXPECT_GT(surface.height_over(kShort, 120, 6 * 1024, road_mm + 420), 220);
    Turn all;
    road(all, 0, 256);
    walk.close_turn(kShort, lows_of(kShort, all), surface);
    EXPECT_LT(surface.height_over(kShort, 120, 6 * 1024, road_mm), 100);
  }
}

// A car hides the road and the lower part of a parked car behind it. The edge of this part is low
// enough for a first ground, but its door and its bonnet are no ground.
TEST(FirstGround, AHalfHiddenCarIsNotGround) {
  Turn turn;
  for (std::int32_t sector = 100; sector < 115; ++sector) {
    for (const auto& [bin, z_mm] :
         {std::array<std::int32_t, 2>{3, 180}, {7, 460}, {9, 780}, {11, 810}, {12, 900}}) {
      turn.push_back({sector, bin * 1024, z_mm});
    }
  }
  SurfaceWalk walk;
  Surface surface;
  for (int turns = 0; turns < 20; ++turns) {
    walk.close_turn(kShort, lows_of(kShort, turn), surface);
    for (const std::int32_t bin : {9, 11, 12}) {
      ASSERT_GT(surface.height_over(kShort, 107, static_cast<std::uint32_t>(bin * 1024), 780), 220)
          << turns << ' ' << bin;
    }
  }
}

// A unit that sees the ground from 7 m on drives towards a slope of 8 %, at 6 m/s in turns of
// 100 ms; one that sees it from 3.5 m on comes to a ramp of 17 % at 3 m/s, which is 51 mm higher
// in each turn. They follow the rise by less than 60 mm from turn to turn, and without the last
// turn they would not: 425 mm are above 150 + 20 x 4 mm.
TEST(FirstGround, TheFirstGroundMayRiseFromTurnToTurn) {
  struct Rise {
    std::int32_t percent, from_mm, foot_mm, way_mm;
  };
  for (const Rise rise : {Rise{8, 7'200, 12'000, 600}, {17, 3'500, 4'000, 300}}) {
    SurfaceWalk walk;
    Surface surface;
    Turn turn;
    for (std::int32_t foot_mm = rise.foot_mm; foot_mm >= 1'000; foot_mm -= rise.way_mm) {
      turn.clear();
      for (std::int32_t sector = 0; sector < tests::kTestSectors; ++sector) {
        for (std::int32_t along_mm = rise.from_mm; along_mm < 30'000; along_mm += 1'024) {
          turn.push_back({sector, along_mm,
                          std::max<std::int32_t>(along_mm - foot_mm, 0) * rise.percent / 100});
        }
      }
      walk.close_turn(kShort, lows_of(kShort, turn), surface);
      for (const Return& its : turn) {
        ASSERT_LE(std::abs(surface.height_over(kShort, 100,
                                               static_cast<std::uint32_t>(its.along_mm), its.z_mm)),
                  100)
            << rise.percent << ' ' << foot_mm << ' ' << its.along_mm;
      }
    }
    EXPECT_GT(
        surface_after(kShort, turn)
            .height_over(kShort, 100, static_cast<std::uint32_t>(rise.from_mm), turn.front().z_mm),
        400);
  }
}

}  // namespace
}  // namespace iog::ground
