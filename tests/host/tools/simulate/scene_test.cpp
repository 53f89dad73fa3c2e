#include "tools/simulate/world/scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "gtest/gtest.h"

#include "../drive_sample.hpp"
#include "fusion/frame_fusion.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/scenes/scene_catalogue.hpp"
#include "tools/simulate/truth/true_occupancy.hpp"

namespace iog::tools {
namespace {

constexpr double kDriveS = 20;

class EveryScene : public testing::TestWithParam<SceneEntry> {
 protected:
  [[nodiscard]] static Scene scene(std::uint64_t seed) { return GetParam().make(seed, kDriveS); }
};

INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(all_scenes()),
                         [](const auto& entry) { return std::string(entry.param.name); });

// Where the height band is that of the ground everywhere.
class EveryFlatScene : public EveryScene {};

INSTANTIATE_TEST_SUITE_P(Scenes, EveryFlatScene,
                         testing::Values(find_scene("city"), find_scene("ring_road"),
                                         find_scene("street")),
                         [](const auto& entry) { return std::string(entry.param.name); });

TEST_P(EveryScene, IsFoundByItsName) {
  EXPECT_EQ(find_scene(GetParam().name).make, GetParam().make);
}

TEST(SceneCatalogue, AnUnknownSceneIsRefused) {
  EXPECT_THROW(static_cast<void>(find_scene("moon")), UsageError);
}

TEST_P(EveryScene, AStationIsAMetreOfTheCentreLine) {
  const Road road = scene(1).road;
  for (double station = -200; station < 300; station += 7) {
    const Placement from = road.at(station, 0);
    const Placement to = road.at(station + 0.5, 0);
    EXPECT_NEAR(std::hypot(to.x - from.x, to.y - from.y), 0.5, 1e-3);
  }
}

TEST_P(EveryScene, TheCarPointsWhereItGoes) {
  const Scene drive = scene(1);
  for (double time_s = 1; time_s < kDriveS; time_s += 0.7) {
    const Placement before = drive.ego_at(time_s - 0.1).at;
    const Placement at = drive.ego_at(time_s).at;
    const Placement after = drive.ego_at(time_s + 0.1).at;
    const double x = after.x - before.x;
    const double y = after.y - before.y;
    const double way = std::hypot(x, y);
    if (way < 0.5) {
      continue;  // on one side of the road's polygon, which is a little oblique to it
    }
    EXPECT_NEAR(at.cos, x / way, 2e-3);
    EXPECT_NEAR(at.sin, y / way, 2e-3);
  }
}

TEST_P(EveryScene, TheCarIsAtAStationWhenItSaysSo) {
  const Cruise cruise = scene(1).cruise;
  for (double station = 0; station < 200; station += 13) {
    EXPECT_NEAR(cruise.station_at(cruise.time_at(station)), station, 1e-6);
  }
}

// Of a thing that keeps by the car as of all others: its speed is the truth of its cells.
TEST_P(EveryScene, AThingGoesFromWhereItIsToWhereItWillBe) {
  const Scene drive = scene(1);
  for (const double from_s : {1.0, 7.3, 14.6}) {
    const double to_s = from_s + 0.02;
    std::vector<Solid> before;
    std::vector<Solid> after;
    drive.append_seen_at(from_s, before);
    drive.append_seen_at(to_s, after);
    std::size_t movers = 0;
    for (const MovingSolid& solid : drive.solids_between(from_s, to_s)) {
      const auto begin = std::ranges::find(before, solid.begin.thing, &Solid::thing);
      const auto end = std::ranges::find(after, solid.begin.thing, &Solid::thing);
      if (solid.begin.thing < kFirstMover || begin == before.end() || end == after.end() ||
          solid.begin.z_low != begin->z_low) {
        continue;  // at the limit of sight, or another part of the thing
      }
      EXPECT_NEAR(solid.begin.at.x, begin->at.x, 1e-9) << solid.begin.thing;
      EXPECT_NEAR(solid.begin.at.y, begin->at.y, 1e-9) << solid.begin.thing;
      EXPECT_NEAR(solid.end.x, end->at.x, 1e-9) << solid.begin.thing;
      EXPECT_NEAR(solid.end.y, end->at.y, 1e-9) << solid.begin.thing;
      ++movers;
    }
    EXPECT_GT(movers, 5U);
  }
}

// A car's cabin is on its body, a tree's leaves are above its trunk, a gantry's beam reaches its
// post.
TEST_P(EveryScene, AThingIsInOnePlaceAndHasItsNumber) {
  const Scene drive = scene(1);
  for (const double time_s : {1.0, 8.0, 15.0}) {
    std::vector<Solid> solids;
    drive.append_seen_at(time_s, solids);
    std::map<std::uint32_t, Solid> things;
    std::map<std::uint32_t, int> parts;
    for (const Solid& solid : solids) {
      EXPECT_NE(solid.thing, 0U);
      const Solid& first = things.emplace(solid.thing, solid).first->second;
      EXPECT_LT(std::hypot(solid.at.x - first.at.x, solid.at.y - first.at.y),
                std::max(std::hypot(solid.half_length, solid.half_width),
                         std::hypot(first.half_length, first.half_width)) +
                    0.5)
          << solid.thing;
      EXPECT_LE(++parts[solid.thing], 8) << solid.thing;
    }
  }
}

// Nothing that is higher than a kerb stands or drives where the car is.
TEST_P(EveryScene, TheWayIsClear) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Scene drive = scene(seed);
    for (double time_s = 0; time_s < kDriveS; time_s += 0.5) {
      std::vector<Solid> solids;
      drive.append_seen_at(time_s, solids);
      const Placement ego = drive.ego_at(time_s).at;
      for (const double forward : {-2.0, 0.0, 2.0}) {
        for (const double left : {-0.9, 0.9}) {
          const Placement corner = moved(ego, forward, left);
          EXPECT_TRUE(std::ranges::none_of(solids,
                                           [&](const Solid& solid) {
                                             return solid.z_low < 2 &&
                                                    covers(solid, corner.x, corner.y);
                                           }))
              << "seed " << seed << " at " << time_s << " s";
        }
      }
    }
  }
}

// Cells that are occupied, and all within that many cells of them, in both directions.
std::vector<bool> grown(const std::vector<bool>& occupied, int reach) {
  constexpr int kSide = geometry::kCellsPerSide;
  const auto cell = [](int x, int y) {
    return static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x);
  };
  std::vector<bool> near(occupied.size());
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      if (!occupied[cell(x, y)]) {
        continue;
      }
      for (int v = std::max(y - reach, 0); v <= std::min(y + reach, kSide - 1); ++v) {
        for (int u = std::max(x - reach, 0); u <= std::min(x + reach, kSide - 1); ++u) {
          near[cell(u, v)] = true;
        }
      }
    }
  }
  return near;
}

// An echo is up to 0.25 m off (3.5 sigma of 0.07 m), one cell by rounding; a beam that meets an
// edge with half its width may be 0.3 m off. The rest: a beam 0.04 degrees beside a thin post, and
// the pitch, which the truth leaves aside.
TEST_P(EveryFlatScene, WhatIsFusedAsOccupiedIsThere) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  constexpr std::uint32_t kFrame = 25;
  Drive drive(car, 1, 2, GetParam());
  const auto fusion = std::make_unique<fusion::FrameFusion>(*car.vehicle);
  for_each_point(drive, kFrame, car,
                 [&](const vehicle::Sensor& sensor, const lidar::ScanPoint& point) {
                   fusion->add(sensor, point);
                 });
  fusion->finish();
  const auto there =
      grown(true_occupancy(drive.ego(kFrame), drive.solids(kFrame), *car.description), 4);
  std::size_t occupied = 0;
  std::size_t wrong = 0;
  for (std::size_t cell = 0; cell < geometry::kCellCount; ++cell) {
    if (fusion->view().at(geometry::cell_of(cell)) > 0) {
      ++occupied;
      wrong += there[cell] ? 0U : 1U;
    }
  }
  EXPECT_GT(occupied, 300U);
  EXPECT_LT(wrong, occupied / 50);
}

}  // namespace
}  // namespace iog::tools
