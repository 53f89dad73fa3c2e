#include "lab/evaluation/true_things.hpp"

#include "gtest/gtest.h"

#include "tools/simulate/scenes/scene_catalogue.hpp"
#include "tools/simulate/scenes/street.hpp"
#include "tools/simulate/truth/cell_truth.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

const description::Description& description() {
  return *tools::find_vehicle(tools::kDefaultVehicle).description;
}

TrueState state_of(double time_s, tools::StreetRole role) {
  const tools::Scene scene = tools::make_street(1, 20);
  const TrueThings things(scene, time_s, description());
  return things.states().at(tools::street_thing(0, role));
}

// docs/drives.md: the visitor has parked at 14.62 s, the leaver leaves at 15 s, the stroller stands
// from 13 to 18 s.
TEST(TrueThings, WhatStopsSettlesForASecond) {
  EXPECT_EQ(state_of(13.0, tools::StreetRole::kVisitor), TrueState::kMovingCar);
  EXPECT_EQ(state_of(15.2, tools::StreetRole::kVisitor), TrueState::kSettling);
  EXPECT_EQ(state_of(15.7, tools::StreetRole::kVisitor), TrueState::kStanding);
  EXPECT_EQ(state_of(14.9, tools::StreetRole::kLeaver), TrueState::kStanding);
  EXPECT_EQ(state_of(15.3, tools::StreetRole::kLeaver), TrueState::kMovingCar);
  EXPECT_EQ(state_of(12.9, tools::StreetRole::kStroller), TrueState::kMovingPerson);
  EXPECT_EQ(state_of(13.5, tools::StreetRole::kStroller), TrueState::kSettling);
  EXPECT_EQ(state_of(14.1, tools::StreetRole::kStroller), TrueState::kStanding);
}

// Every cell that the truth of cells says is covered is near that thing or one that goes before it;
// a cell without anything within 0.3 m is near nothing.
TEST(TrueThings, AgreeWithTheTruthOfCells) {
  const tools::Scene scene = tools::find_scene("city").make(3, 5);
  constexpr double kTimeS = 4;
  const tools::CellArea area = tools::cells_around(scene.ego_at(kTimeS));
  const auto cells = tools::true_cells(scene, kTimeS, area, description());
  const TrueThings things(scene, kTimeS, description());
  std::uint64_t covered = 0;
  std::uint64_t moving = 0;
  for (std::size_t i = 0; i < cells.size(); i += 7) {
    if (cells[i].what == tools::TrueClass::kFree) {
      continue;
    }
    const auto x = static_cast<std::int32_t>(i % static_cast<std::size_t>(area.width));
    const auto y = static_cast<std::int32_t>(i / static_cast<std::size_t>(area.width));
    const TrueThing near = things.near((area.x + x + 0.5) * 0.1, (area.y + y + 0.5) * 0.1);
    ++covered;
    if (cells[i].what == tools::TrueClass::kMoving) {
      ++moving;
      EXPECT_TRUE(moves(near.state));
    } else {
      EXPECT_NE(near.state, TrueState::kNothing);
    }
  }
  EXPECT_GT(covered, 1000U);
  EXPECT_GT(moving, 20U);
}

// What a thing goes in 40 ms is its velocity times that, also of a car that keeps by the car
// itself: those are numbered first. Nothing here brakes so hard that it would be off by 1 cm.
TEST(TrueThings, AreAsFastAsTheWayThatTheyGo) {
  for (const std::string_view name : {"city", "ring_road", "street"}) {
    const tools::Scene scene = tools::find_scene(name).make(3, 5);
    std::uint64_t companions = 0;
    std::uint64_t checked = 0;
    for (const double time_s : {1.0, 2.7, 4.4}) {
      const auto before = TrueThings(scene, time_s - 0.02, description()).motions();
      const auto after = TrueThings(scene, time_s + 0.02, description()).motions();
      const TrueThings now(scene, time_s, description());
      for (const auto& [thing, motion] : now.motions()) {
        EXPECT_TRUE(moves(now.states().at(thing)));
        EXPECT_EQ(motion.is_person, now.states().at(thing) == TrueState::kMovingPerson);
        if (!before.contains(thing) || !after.contains(thing)) {
          continue;  // at the limit of sight
        }
        EXPECT_NEAR(after.at(thing).x_m - before.at(thing).x_m, 0.04 * motion.x_mps, 0.01) << thing;
        EXPECT_NEAR(after.at(thing).y_m - before.at(thing).y_m, 0.04 * motion.y_mps, 0.01) << thing;
        companions += thing < tools::kFirstMover + scene.traffic.companions.size() ? 1U : 0U;
        ++checked;
      }
    }
    EXPECT_EQ(companions, 3 * scene.traffic.companions.size()) << name;
    EXPECT_GT(checked, 20U) << name;
  }
}

// A lone corner of the city's first thing that is a box: 0.19 m beyond it is near, 0.21 m is not.
TEST(TrueThings, ReachTwentyCentimetresBeyondAnOutline) {
  const tools::Scene scene = tools::find_scene("ring_road").make(3, 5);
  const TrueThings things(scene, 1, description());
  std::uint64_t checked = 0;
  for (const auto& [thing, state] : things.states()) {
    const std::vector<tools::Solid> outlines = things.outlines_of(thing);
    if (!moves(state) || outlines.size() != 1) {
      continue;  // of lorries, which are far from everything else, one box each
    }
    const tools::Solid& box = outlines.front();
    for (const auto& [beyond, is_near] : {std::pair{0.19, true}, std::pair{0.21, false}}) {
      const double along = box.half_length + beyond;
      EXPECT_EQ(things.is_near_mover(box.at.x + along * box.at.cos, box.at.y + along * box.at.sin),
                is_near);
    }
    ++checked;
  }
  EXPECT_GT(checked, 0U);
}

}  // namespace
}  // namespace iog::lab
