#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "gtest/gtest.h"

#include "grid/frame_fusion.hpp"
#include "index/recursive_set.hpp"
#include "lab/experiments/detection_quality/choice_maps.hpp"
#include "lab/experiments/detection_quality/quality_choices.hpp"
#include "lab/experiments/fusion_trial.hpp"
#include "lab/experiments/price_of_hits_win/false_echoes.hpp"
#include "lab/experiments/price_of_hits_win/priced_fusions.hpp"

namespace iog::lab {
namespace {

const tools::CatalogueEntry& reference_car() { return tools::find_vehicle("reference_car"); }

SensorPoint seen_by(std::size_t sensor, std::uint32_t range_mm, std::uint16_t azimuth_ticks,
                    std::uint8_t echo = 0) {
  return {
      .sensor = sensor,
      .point = {.range_mm = range_mm, .azimuth_ticks = azimuth_ticks, .layer = 1, .echo = echo}};
}

bool is_same(const FramePoints& a, const FramePoints& b) {
  return std::equal(
      a.begin(), a.end(), b.begin(), b.end(), [](const SensorPoint& x, const SensorPoint& y) {
        return x.sensor == y.sensor && x.point.range_mm == y.point.range_mm &&
               x.point.azimuth_ticks == y.point.azimuth_ticks && x.point.echo == y.point.echo;
      });
}

// Two beams of one scanner: three echoes, and one.
const FramePoints kTwoBeams{seen_by(1, 20'000, 0, 0), seen_by(1, 22'000, 0, 1),
                            seen_by(1, 30'000, 0, 2), seen_by(1, 9'000, 16, 0)};

TEST(Rain, NoneFallsAtRateZero) {
  tools::Random random(1);
  const Rained dry =
      with_rain(kTwoBeams, *reference_car().vehicle, 0, TrueEcho::kComesLater, random);
  EXPECT_EQ(dry.drops, 0U);
  EXPECT_TRUE(is_same(dry.points, kTwoBeams));
}

TEST(Rain, EveryBeamBeginsWithADropAtRateOne) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    tools::Random random(seed);
    const Rained wet =
        with_rain(kTwoBeams, *reference_car().vehicle, 1, TrueEcho::kComesLater, random);
    EXPECT_EQ(wet.drops, 2U);
    ASSERT_EQ(wet.points.size(), 5U);  // a LUX has three echoes: the last of the first beam is gone
    const FramePoints expected{seen_by(1, wet.points[0].point.range_mm, 0, 0),
                               seen_by(1, 20'000, 0, 1), seen_by(1, 22'000, 0, 2),
                               seen_by(1, wet.points[3].point.range_mm, 16, 0),
                               seen_by(1, 9'000, 16, 1)};
    EXPECT_TRUE(is_same(wet.points, expected));
    for (const std::size_t drop : {0U, 3U}) {
      EXPECT_GE(wet.points[drop].point.range_mm, 1000U);
      EXPECT_LT(wet.points[drop].point.range_mm, wet.points[drop + 1].point.range_mm);
      EXPECT_FALSE(wet.points[drop].point.is_rain);
    }
  }
}

TEST(Rain, TheTrueEchoesCanBeLost) {
  tools::Random random(3);
  const Rained wet = with_rain(kTwoBeams, *reference_car().vehicle, 1, TrueEcho::kIsLost, random);
  EXPECT_EQ(wet.points.size(), 2U);
}

// The scanner in the middle sits at x = 2.05 m: 5.95 m from a ghost at 8 m. Its noise ends at 3.5
// sigma, 0.245 m.
TEST(Ghost, HidesWhatItsSensorSeesBehindIt) {
  const Ghost ghost{.sensor = 1, .x_m = 8, .half_width_m = 0.5};
  const FramePoints points{seen_by(1, 20'000, 0, 0), seen_by(1, 25'000, 0, 1),  // through the ghost
                           seen_by(1, 3'000, 0, 0),                             // before it
                           seen_by(1, 20'000, 320, 0),  // 10 degrees aside: 1.05 m
                           seen_by(0, 20'000, 0, 0)};   // another sensor's
  tools::Random random(5);
  const FramePoints haunted = with_ghost(points, reference_car(), ghost, random);
  ASSERT_EQ(haunted.size(), 4U);
  EXPECT_NEAR(haunted[0].point.range_mm, 5950, 245);
  EXPECT_TRUE(is_same({haunted.begin() + 1, haunted.end()}, {points.begin() + 2, points.end()}));
}

// A wall across the way, 10 m before the scanner in the middle, and nothing else.
TEST(StandingCar, SeesASceneMadeByHand) {
  const std::vector<tools::Solid> wall{
      box(tools::Material::kWall, {.x = 12.55, .y = 0}, 1, 40, 0, 3)};
  StandingCar car(reference_car());
  tools::Random random(1);
  std::vector<double> ahead;
  for (const SensorPoint& seen : car.look_at(wall, random)) {
    if (seen.sensor == 1 && seen.point.azimuth_ticks == 0 && !seen.point.is_rain) {
      ahead.push_back(seen.point.range_mm);
    }
  }
  ASSERT_FALSE(ahead.empty());
  for (const double range_mm : ahead) {
    EXPECT_NEAR(range_mm, 10'000, 255);
  }
}

// Whatever epsilon a grid was fused with, and in whatever form: the index of a probability is that
// of the recursive set of 0.05.
TEST(FusedGrid, SpeaksInIndexesOfTheDefaultEpsilon) {
  for (const std::int32_t n : {-14, -1, 0, 2, 7}) {
    const FusedGrid indexes{.cells = std::vector{n}};
    const FusedGrid in_double{.cells = std::vector{index::RecursiveSet(0.05).probability(n)}};
    EXPECT_NEAR(indexes.index_at(0), n, 1e-9);
    EXPECT_NEAR(in_double.index_at(0), n, 1e-9);
    const FusedGrid coarse{.cells = std::vector{n}, .epsilon = 0.1};
    const FusedGrid same{.cells = std::vector{index::RecursiveSet(0.1).probability(n)}};
    EXPECT_NEAR(coarse.index_at(0), same.index_at(0), 1e-9);
  }
}

TEST(FusedGrid, TakesWhatSaysNothingForUnknown) {
  const FusedGrid grid{.cells = std::vector{0.4995, 0.5, 0.5005, 0.45, 0.55}};
  const std::vector<CellState> expected{CellState::kUnknown, CellState::kUnknown,
                                        CellState::kUnknown, CellState::kFree,
                                        CellState::kOccupied};
  EXPECT_EQ(grid.states(), expected);
  EXPECT_EQ(grid.index_at(2), 0);
}

TEST(Choices, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Choice& choice : all_choices()) {
    EXPECT_TRUE(names.insert(choice.name).second) << choice.name;
  }
  for (const auto& list :
       {rule_choices(), quantisation_choices(), traversal_choices(), sampling_choices()}) {
    for (const Choice& choice : list) {
      EXPECT_TRUE(names.contains(choice.name)) << choice.name;
    }
  }
  EXPECT_EQ(name_of(IndexFusion{}), kHitsWinName);
  EXPECT_EQ(name_of(IndexRule::kHitsWin, {}), kHitsWinName);
  EXPECT_EQ(name_of(IndexFusion{.rule = IndexRule::kBayes, .epsilon = 0.005, .limit = kNoLimit}),
            "bayes, epsilon 0.005, wide");
}

// hits_win keeps every hit by what it says; the sum of one hit and one beam through its cell is
// negative.
TEST(Trials, ABeamOverAHitErasesItUnderTheSumAlone) {
  const FramePoints points{seen_by(1, 10'000, 0), seen_by(1, 20'000, 0)};
  Trials trials(reference_car(), {{.name = "hits_win", .fusion = IndexFusion{}},
                                  {.name = "sum", .fusion = IndexFusion{.rule = IndexRule::kBayes}},
                                  {.name = "double", .fusion = ProbabilityRule::kBayes}});
  trials.add(points);
  EXPECT_EQ(trials.at("hits_win").ended.lost(), 0);
  EXPECT_EQ(trials.at("sum").ended.lost(), 0.5);
  EXPECT_EQ(trials.at("double").ended.lost(), 0.5);
  EXPECT_EQ(trials.at("sum").frames, 1U);
  EXPECT_THROW(static_cast<void>(trials.at("none")), std::out_of_range);
}

// A truth of nothing but visibly free cells, here those around the axis: every occupied cell is a
// phantom.
TEST(Trials, CountPhantoms) {
  Trials trials(reference_car(), {{.name = "hits_win", .fusion = IndexFusion{}}});
  std::vector<CellState> nothing(geometry::kCellCount, CellState::kUnknown);
  constexpr std::ptrdiff_t kRow = geometry::kCellsPerSide;
  std::fill_n(nothing.begin() + 490 * kRow, 50 * kRow, CellState::kFree);
  trials.add({seen_by(1, 10'000, 0), seen_by(1, 20'000, 160)}, nothing);
  trials.add({}, nothing);
  EXPECT_EQ(trials.at("hits_win").phantoms_per_frame(), 1);
}

TEST(CellsWithin, AreThoseWhoseCentresAreInside) {
  const auto cells = cells_within(12, 12.3, -0.1, 0.1);
  const std::vector<std::size_t> expected{511 * 1024 + 632, 511 * 1024 + 633, 511 * 1024 + 634,
                                          512 * 1024 + 632, 512 * 1024 + 633, 512 * 1024 + 634};
  EXPECT_EQ(cells, expected);
}

// One hit is +2 and one beam -14 in the vehicle's int8; two of them are more.
TEST(ChoiceMaps, HaveALetterForEachKindOfCell) {
  std::string letters;
  for (const double index : {4.0, 2.0, 0.0, -14.0, -28.0}) {
    letters += letter_of(index);
  }
  EXPECT_EQ(letters, "Oo.fF");
}

std::string text_of(const Tables& tables, std::string_view name) {
  const auto table = std::find_if(tables.begin(), tables.end(),
                                  [name](const Table& each) { return each.name() == name; });
  return table == tables.end() ? "" : table->text();
}

// A visibly occupied cell at x = 571, y = 437: the first row, the second letter. Row 447 has none.
TEST(ChoiceMaps, BeginAtTheirFirstCell) {
  KnownFrame frame{.car = &reference_car(), .points = {}, .truth = {}};
  frame.truth.assign(geometry::kCellCount, CellState::kUnknown);
  frame.truth[std::size_t{437} * geometry::kCellsPerSide + 571] = CellState::kOccupied;
  const std::string text = text_of(choice_maps(frame), "choice_map_truth");
  EXPECT_NE(text.find("\ntruth,570,437,.O.."), std::string::npos);
  EXPECT_NE(text.find("\ntruth,570,447," + std::string(150, '.') + "\n"), std::string::npos);
}

}  // namespace
}  // namespace iog::lab
