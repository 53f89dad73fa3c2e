// The surface of a turn: that of the second implementation in every height, whatever the turn; and
// laws that hold without it.
#include "ground/surface_walk.hpp"

#include <algorithm>
#include <cstdlib>
#include <gtest/gtest.h>
#include <initializer_list>
#include <vector>

#include "fakes/ground_turns.hpp"
#include "fakes/random.hpp"
#include "fakes/reference_ground.hpp"
#include "fakes/walked_turns.hpp"

namespace iog::ground {
namespace {

using tests::GroundRule;
using tests::kLong;
using tests::kShort;
using tests::lows_of;
using tests::Random;
using tests::Return;
using tests::surface_after;
using tests::Turn;

std::int32_t length_of(Bins bins) { return static_cast<std::int32_t>(bins.length_mm()); }

// A sensor that has seen one turn after the other, in both implementations.
class Both {
 public:
  explicit Both(Bins bins, const GroundRule& rule = {})
      : bins_(bins), reference_(length_of(bins), rule) {}

  void close_turn(const Turn& turn) {
    walk_.close_turn(bins_, lows_of(bins_, turn), surface_);
    for (const Return& its : turn) {
      reference_.see(its.sector, its.along_mm, its.z_mm);
    }
    reference_.close_turn();
  }

  [[nodiscard]] bool are_equal() const {
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      const auto number = static_cast<std::int32_t>(sector);
      const auto kept = reference_.turns_kept(number);
      const Surface::Source source = !kept        ? Surface::Source::kFlat
                                     : *kept == 0 ? Surface::Source::kOwn
                                                  : Surface::Source::kKept;
      if (surface_.source(sector) != source ||
          !std::ranges::equal(surface_.row(sector), reference_.row(number))) {
        return false;
      }
    }
    return true;
  }

  [[nodiscard]] const Surface& surface() const { return surface_; }

 private:
  Bins bins_;
  SurfaceWalk walk_;
  Surface surface_;
  tests::ReferenceGround reference_;
};

// All kinds of turns, the same whoever asks.
std::vector<Turn> all_turns(Bins bins) {
  Random random(30);
  std::vector<Turn> turns{{}};
  for (int i = 0; i < 8; ++i) {
    turns.push_back(tests::rough_turn(random, length_of(bins)));
    turns.push_back(tests::turn_at_limits(random, length_of(bins)));
    turns.push_back(tests::turn_at_limits(random, length_of(bins)));
    turns.push_back(tests::turn_beside(random, length_of(bins)));
    turns.push_back(tests::turn_beside(random, length_of(bins)));
    turns.push_back(tests::any_turn(random, 1 << random.between(0, 13)));
    turns.push_back(tests::steep_turn(random, length_of(bins)));
    turns.push_back(tests::doubtful_ground(length_of(bins)));
    turns.push_back(tests::mirror_images(length_of(bins)));
    turns.push_back(tests::first_ground(length_of(bins), 0));
    turns.push_back(tests::first_ground(length_of(bins), 1));
    turns.push_back(tests::ground_apart(length_of(bins), 0));
    turns.push_back(tests::ground_apart(length_of(bins), 1));
  }
  return turns;
}

TEST(SurfaceWalk, HasEveryHeightOfTheSecondImplementation) {
  for (const Bins bins : {kShort, kLong}) {
    Both both(bins);
    for (const Turn& turn : all_turns(bins)) {
      both.close_turn(turn);
      ASSERT_TRUE(both.are_equal());
    }
  }
}

// One return a bin, at the ends of what a word holds.
TEST(SurfaceWalk, TakesHeightsOfAnySize) {
  for (const Bins bins : {kShort, kLong}) {
    for (const std::int32_t z :
         {-40'000, -32'768, -32'767, -14'700, -14'000, 14'000, 14'700, 32'766, 32'767, 40'000}) {
      Both both(bins);
      Turn turn;
      for (std::int32_t sector = 0; sector < tests::kTestSectors; ++sector) {
        for (std::int32_t bin = 0; bin < tests::kTestBins; ++bin) {
          turn.push_back({sector, bin * length_of(bins), (sector + bin) % 3 == 0 ? -z : z});
        }
      }
      both.close_turn(turn);
      EXPECT_TRUE(both.are_equal()) << z;
    }
  }
}

// The turns of these tests meet each number of the rule: with any of them one larger or smaller,
// the second implementation finds another surface.
TEST(SurfaceWalk, ATestSeesEachOfItsNumbers) {
  constexpr int kNumbers = 24;
  const auto number_of = [](GroundRule& rule, int number) -> tests::Whole& {
    const std::array<tests::Whole*, kNumbers> all{
        &rule.plausible,  &rule.plausible_rise,   &rule.most_plausible, &rule.start,
        &rule.start_rise, &rule.steep_start_rise, &rule.over_last,      &rule.step,
        &rule.step_rise,  &rule.widest,           &rule.slope_parts,    &rule.steepest,
        &rule.reach,      &rule.across,           &rule.beside,         &rule.over_lowest,
        &rule.high_start, &rule.near_starts,      &rule.proofs,         &rule.doubtful_widest,
        &rule.mirrored,   &rule.mirrored_sectors, &rule.over_apart,     &rule.apart};
    return *all[static_cast<std::size_t>(number)];
  };
  const std::vector<Turn> turns = all_turns(kShort);
  for (int number = 0; number < kNumbers; ++number) {
    for (const int more : {1, -1}) {
      GroundRule rule;
      number_of(rule, number) += more;
      Both both(kShort, rule);
      EXPECT_TRUE(std::ranges::any_of(turns,
                                      [&](const Turn& turn) {
                                        both.close_turn(turn);
                                        return !both.are_equal();
                                      }))
          << "number " << number << ' ' << more;
    }
  }
}

// lab/notes/2026-11-28-ground.md, "One sector, bin by bin": a parked car in sectors 9 to 11, and
// the road beside it in sector 14.
TEST(SurfaceWalk, HasThePagesExample) {
  Turn turn;
  const auto see = [&](std::int32_t sector, std::initializer_list<std::array<int, 2>> lows) {
    for (const auto& [bin, z] : lows) {
      turn.push_back({sector, bin * 1024, z});
    }
  };
  for (const std::int32_t sector : {9, 10, 11}) {
    see(sector, {{3, 20}, {4, 31}, {5, 45}, {7, 70}, {8, 410}, {9, 395}, {10, 118}, {11, 150}});
  }
  see(14, {{3, 22}, {4, 30}, {5, 44}, {6, 55}, {7, 68}, {8, 84}, {9, 99}, {10, 116}, {11, 148}});
  const Surface surface = surface_after(kShort, turn);
  const std::array<std::int16_t, 13> starts{0, 7, 12, 17, 25, 38, 50, 62, 77, 91, 108, 134, 157};
  EXPECT_TRUE(std::equal(starts.begin(), starts.end(), surface.row(10).begin()));
  EXPECT_EQ(surface.height_over(kShort, 10, 8'300, 390), 312);
  EXPECT_EQ(surface.height_over(kShort, 10, 8'300, 150), 72);
}

// A return far below the car's plane and those of the sectors on both sides, as seen by a forger
// who adds some where there are none.
bool may_be_mirrored(const Lows::Ring& lows, std::size_t sector) {
  const std::int32_t highest = lows[sector] + 1'000;
  const auto is_higher = [&](std::size_t other) { return lows[other % kSectors] > highest; };
  return lows[sector] < -1'000 && is_higher(sector + 3) && is_higher(sector + kSectors - 3);
}

// Whatever else is received, nowhere in a bin is the ground more than 150 mm over what was seen
// there, unless it may be a mirror image: what is forged cannot hide what is real.
TEST(SurfaceWalk, StaysLowOverRealReturnsWhateverIsForged) {
  Random random(7);
  for (int i = 0; i < 12; ++i) {
    Turn turn = tests::rough_turn(random, 1024);
    const Lows real = lows_of(kShort, turn);
    const Turn forged =
        i % 3 == 0 ? tests::any_turn(random, 20'000) : tests::rough_turn(random, 1024);
    turn.insert(turn.end(), forged.begin(), forged.end());
    const Surface surface = surface_after(kShort, turn);
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      for (std::size_t sector = 0; sector < kSectors; ++sector) {
        const std::int32_t low = real.ring(bin)[sector];
        if (low <= kShort.most_plausible_mm(static_cast<std::uint32_t>(bin)) &&
            !may_be_mirrored(real.ring(bin), sector)) {
          ASSERT_LE(surface.row(sector)[bin], low + kMostOverLowestMm);
          ASSERT_LE(surface.row(sector)[bin + 1], low + kMostOverLowestMm);
        }
      }
    }
  }
}

// A ramp of forged returns where nothing real is seen, beside a thing and before it: the thing
// stays one.
TEST(SurfaceWalk, AForgedRampHidesNothing) {
  Turn turn;
  for (std::int32_t sector = 0; sector < tests::kTestSectors; ++sector) {
    for (std::int32_t bin = 0; bin < tests::kTestBins; ++bin) {
      const bool is_thing = sector >= 60 && sector < 64 && bin == 20;
      const std::int32_t ramp = 150 + 80 * (bin + 1);
      turn.push_back({sector, bin * 1024, is_thing ? 300 : ramp});
    }
  }
  const Surface surface = surface_after(kShort, turn);
  EXPECT_GE(surface.height_over(kShort, 61, 20 * 1024 + 500, 700), 250);
}

// Ground is found wherever there were returns, to the middle of a bin: a plane that is level, or
// that rises by one degree or falls by five, or a ramp of 17 % from 3 m on; and no worse with 30 %
// or 60 % of the packets lost, each of which has a sector of its own here.
TEST(SurfaceWalk, FindsPlanesAndRamps) {
  struct Ground {
    std::int32_t permille;
    std::int32_t from_mm;
  };
  for (const Ground ground : {Ground{0, 0}, {17, 0}, {-87, 0}, {170, 3'000}, {-170, 3'000}}) {
    for (const int lost_of_ten : {0, 3, 6}) {
      Random random(8);
      Turn turn;
      for (std::int32_t sector = 0; sector < tests::kTestSectors; ++sector) {
        if (random.between(0, 9) < lost_of_ten) {
          continue;
        }
        for (std::int32_t bin = 3; bin < tests::kTestBins; ++bin) {
          const std::int32_t along = bin * 1024 + random.between(0, 1023);
          const std::int32_t z =
              std::max<std::int32_t>(along - ground.from_mm, 0) * ground.permille / 1000;
          turn.push_back({sector, along, z + random.between(-20, 20)});
        }
      }
      const Surface surface = surface_after(kShort, turn);
      for (const Return& its : turn) {
        const std::int32_t height =
            surface.height_over(kShort, static_cast<std::uint32_t>(its.sector),
                                static_cast<std::uint32_t>(its.along_mm), its.z_mm);
        ASSERT_LE(std::abs(height), 200) << ground.permille << ' ' << lost_of_ten;
      }
    }
  }
}

// A kerb of 12 cm is ground, a wall is none, and a bridge neither; behind the wall the ground goes
// on.
TEST(SurfaceWalk, KnowsKerbsWallsAndBridges) {
  Turn turn;
  for (std::int32_t sector = 0; sector < tests::kTestSectors; ++sector) {
    for (std::int32_t bin = 2; bin < 50; ++bin) {
      const bool is_wall = bin >= 20 && bin < 24;
      const bool is_bridge = bin >= 30 && bin < 34;
      turn.push_back({sector, bin * 1024, is_wall ? 2'000 : bin < 10 ? 0 : 120});
      if (is_bridge) {
        turn.push_back({sector, bin * 1024 + 500, 4'500});
      }
    }
  }
  const Surface surface = surface_after(kShort, turn);
  const auto height = [&](std::uint32_t bin, std::int32_t z) {
    return surface.height_over(kShort, 100, bin * 1024 + 512, z);
  };
  EXPECT_EQ(height(5, 0), 0);
  EXPECT_EQ(height(15, 120), 0);
  EXPECT_EQ(height(21, 2'000), 1'880);
  EXPECT_EQ(height(31, 4'500), 4'380);
  EXPECT_EQ(height(40, 120), 0);
}

// One sector sees the mirror image of a wall under the road. Its neighbours outvote it but for what
// keeps forged ground low.
TEST(SurfaceWalk, OutvotesAMirrorImage) {
  Turn turn;
  for (std::int32_t sector = 0; sector < tests::kTestSectors; ++sector) {
    for (std::int32_t bin = 0; bin < 30; ++bin) {
      turn.push_back({sector, bin * 1024, sector == 77 && bin == 12 ? -140 : 0});
    }
  }
  EXPECT_EQ(surface_after(kShort, turn).row(77)[12], 0);
}

// A wall on the right is mirrored by the road in up to three sectors and two bins. The road above
// the mirror images stays ground, and they are under it. A hole that is wider is a hole.
TEST(SurfaceWalk, MirrorImagesOfUpToThreeSectorsAreNotGround) {
  for (const std::uint32_t sectors : {1U, 2U, 3U, 5U}) {
    Turn turn;
    for (std::int32_t sector = 0; sector < tests::kTestSectors; ++sector) {
      for (std::int32_t bin = 2; bin < 30; ++bin) {
        turn.push_back({sector, bin * 1024 + 512, -100});
        if ((bin == 8 || bin == 9) && sector >= 244 && sector < 244 + static_cast<int>(sectors)) {
          turn.push_back({sector, bin * 1024 + 300, -2'200});
        }
      }
    }
    const Surface surface = surface_after(kShort, turn);
    for (const std::uint32_t along_mm : {8'704U, 9'728U}) {
      const bool is_road_ground = surface.height_over(kShort, 245, along_mm, -100) < 220;
      EXPECT_EQ(is_road_ground, sectors <= 3) << sectors << ' ' << along_mm;
      EXPECT_TRUE(sectors > 3 || surface.height_over(kShort, 245, along_mm, -2'200) < -400);
    }
  }
}

// Ten turns without a return leave the rows, one more forgets them.
TEST(SurfaceWalk, KeepsWhatWasSeenForTenTurns) {
  SurfaceWalk walk;
  Surface surface;
  Turn turn;
  for (std::int32_t bin = 0; bin < 20; ++bin) {
    turn.push_back({5, bin * 1024, 50});
  }
  walk.close_turn(kShort, lows_of(kShort, turn), surface);
  const Surface::Row row = surface.row(5);
  EXPECT_EQ(surface.count(Surface::Source::kOwn), 1U);
  for (int silent = 0; silent < 10; ++silent) {
    walk.close_turn(kShort, Lows(), surface);
    EXPECT_EQ(surface.row(5), row);
    EXPECT_EQ(surface.count(Surface::Source::kKept), 1U);
  }
  walk.close_turn(kShort, Lows(), surface);
  EXPECT_EQ(surface, Surface());
}

}  // namespace
}  // namespace iog::ground
