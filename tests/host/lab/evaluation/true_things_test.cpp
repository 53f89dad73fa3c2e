#include "lab/evaluation/true_things.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

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
