// What a map may do to the names of cells, on drives of the simulator: name, and nothing else.
#include "lab/experiments/map_quality/map_quality.hpp"

#include <array>
#include <numeric>

#include "gtest/gtest.h"

#include "lab/experiments/map_quality/scene_maps.hpp"
#include "map/block.hpp"
#include "tools/simulate/scenes/scene_catalogue.hpp"

namespace iog::lab {
namespace {

// docs/spec.md 3.9
enum Named : std::size_t {
  kUnknown,
  kDrivable,
  kNonDrivable,
  kFree,
  kMoving,
  kStopped,
  kStoppedOrUnmapped,
  kInfrastructure,
  kOccupied
};

constexpr MapDrive kDrive{.scene = "city", .seed = 5, .seconds = 2, .first_scored = 29};

std::uint64_t all_of(const MapScore& score, Named name) {
  return std::accumulate(score.cells[name].begin(), score.cells[name].end(), std::uint64_t{0});
}

TEST(MapQuality, AMapNamesAndChangesNothingElse) {
  const std::vector<MapVariant> variants = map_variants();
  const std::vector<MapScore> scores = score_maps(kDrive, variants);
  const MapScore& none = scores.front();
  EXPECT_EQ(all_of(none, kDrivable) + all_of(none, kNonDrivable) + all_of(none, kStopped) +
                all_of(none, kInfrastructure),
            0U);
  for (std::size_t i = 1; i < scores.size(); ++i) {
    for (std::size_t truth = 0; truth < kNameTruthCount; ++truth) {
      const auto& cells = scores[i].cells;
      EXPECT_EQ(cells[kDrivable][truth] + cells[kNonDrivable][truth] + cells[kFree][truth],
                none.cells[kFree][truth]);
      EXPECT_EQ(cells[kUnknown][truth], 0U);
    }
    EXPECT_GT(all_of(scores[i], kDrivable), 10'000U) << variants[i].name;
    EXPECT_GT(all_of(scores[i], kNonDrivable), 10'000U) << variants[i].name;
  }
}

TEST(MapQuality, ScoresEveryTenthFrameFromTheFirstOn) {
  const auto cells = [](std::uint32_t first) {
    const MapDrive drive{.scene = "city", .seed = 5, .seconds = 1, .first_scored = first};
    return all_of(score_maps(drive, std::array{MapVariant{"none"}}).front(), kFree);
  };
  const std::uint64_t last = cells(19);
  EXPECT_GT(last, 0U);
  EXPECT_EQ(cells(18), last);
  EXPECT_GT(cells(9), last);
  EXPECT_EQ(cells(20), 0U);
}

// With a map that is right no free ground beside a road is drivable.
TEST(MapQuality, ARightMapNamesTheGroundAsItIs) {
  const std::vector<MapVariant> variants = map_variants();
  const auto scores = score_maps(kDrive, variants);
  ASSERT_EQ(variants[1].name, "right");
  const auto beside = static_cast<std::size_t>(NameTruth::kBeside);
  const auto road = static_cast<std::size_t>(NameTruth::kRoad);
  EXPECT_EQ(scores[1].cells[kDrivable][beside], 0U);
  EXPECT_EQ(scores[1].cells[kNonDrivable][road], 0U);
}

TEST(SceneMaps, ABlockHasWhatIsDrawn) {
  const tools::Scene scene = tools::find_scene("ring_road").make(2, 4);
  const tools::DrawnMap drawn = tools::drawn_map(scene, {.missing = 0.5, .ghosts = 2}, 1, 4);
  const std::vector<std::uint8_t> bytes = block_of(drawn, {}, 300);
  ASSERT_EQ(map::check(bytes), map::Refusal::kNone);
  const map::Block block(bytes);
  EXPECT_EQ(block.origin(), tools::MapPlace{}.transform().origin);
  EXPECT_EQ(block.accuracy_mm(), 300U);
  std::size_t houses = 0;
  for (std::uint32_t i = 0; i < block.feature_count(); ++i) {
    houses += block.feature(i).kind() == map::Kind::kBuilding ? 1U : 0U;
  }
  EXPECT_EQ(houses, drawn.houses.size());
}

}  // namespace
}  // namespace iog::lab
