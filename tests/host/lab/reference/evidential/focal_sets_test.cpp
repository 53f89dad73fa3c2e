// What the thesis's grid would have to store, with a map in every scan and without.
#include "lab/reference/evidential/focal_sets.hpp"

#include <array>
#include <gtest/gtest.h>
#include <vector>

#include "lab/reference/evidential/perception.hpp"

namespace iog::lab::reference::evidential {
namespace {

// How a cell's map is given: no map, one class, or some mass on each of the three.
constexpr Set kNoMap = 0;
constexpr Set kMixed = 7;

MassFunction map_of(Set map_classes) {
  if (map_classes == kNoMap) {
    return MassFunction(kPerceptionElements);
  }
  if (map_classes == kMixed) {
    const MassFunction classes(3, {{kBuilding, 0.3}, {kRoad, 0.3}, {kIntermediate, 0.3}});
    return refined(classes, kMapImages, kPerceptionElements);
  }
  return map_evidence(map_classes, 0.97);
}

// Discounting, fusion with a scan and specialisation, from a grid that knows nothing.
FocalSets focal_sets_of(Set map_classes, Ageing ageing, Specialised which) {
  const MassFunction scan = dempster(source_evidence(0.4, 0.4), map_of(map_classes));
  const ScanParameters parameters{.ageing = ageing};
  const std::vector<Operation> operations{
      [=](const MassFunction& mass) { return aged(mass, parameters); },
      [=](const MassFunction& mass) { return fused_in_time(mass, scan).mass; },
      [=](const MassFunction& mass) { return specialised(mass, 0.5, which); }};
  return closure(kPerceptionElements, operations);
}

void expect_counts(Ageing ageing, Specialised which, const std::array<std::size_t, 5>& expected) {
  constexpr std::array kMaps{kNoMap, kBuilding, kRoad, kIntermediate, kMixed};
  for (std::size_t i = 0; i < kMaps.size(); ++i) {
    EXPECT_EQ(focal_sets_of(kMaps[i], ageing, which).count(), expected[i]) << "map " << kMaps[i];
  }
}

// Three sets, as a lidar says them, with no rule for time at all.
TEST(FocalSets, OfALidarAlone) {
  const MassFunction scan = source_evidence(0.4, 0.4);
  const std::array<Operation, 1> fusion{
      [&](const MassFunction& mass) { return dempster(mass, scan); }};
  EXPECT_EQ(closure(kPerceptionElements, fusion).count(), 3U);
}

// The columns: no map, building, road, intermediate space, all three.
TEST(FocalSets, OfTheThesis) {
  for (const Ageing ageing :
       {Ageing::kClassical, Ageing::kConservative, Ageing::kOptimistic, Ageing::kProportional}) {
    expect_counts(ageing, Specialised::kEverySet, {6, 7, 11, 11, 17});
    expect_counts(ageing, Specialised::kOccupiedSets, {5, 6, 9, 9, 14});
  }
}

TEST(FocalSets, OfContextualDiscounting) {
  expect_counts(Ageing::kContextual, Specialised::kEverySet, {7, 11, 17, 17, 33});
  expect_counts(Ageing::kContextual, Specialised::kOccupiedSets, {7, 10, 16, 16, 29});
}

// Without a map four masses are enough, and what they leave: the cell of the perception grid.
TEST(FocalSets, OfACellThatKnowsNoMap) {
  FocalSets expected;
  for (const Set set : {kFree, kOccupied, kMoving, kStanding, kAnything}) {
    expected.set(set);
  }
  EXPECT_EQ(focal_sets_of(kNoMap, Ageing::kConservative, Specialised::kOccupiedSets), expected);
}

}  // namespace
}  // namespace iog::lab::reference::evidential
