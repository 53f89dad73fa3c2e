#include "lab/evaluation/detection.hpp"

#include <array>
#include <cstdint>
#include <vector>

#include "gtest/gtest.h"

#include "drawn_cells.hpp"

namespace iog::lab {
namespace {

TEST(CellStates, AreTheSideOfUnknown) {
  constexpr std::array<std::int32_t, 3> kIndexes{-1, 0, 2};
  constexpr std::array kProbabilities{0.49, 0.5, 0.51};
  const std::vector<CellState> expected{CellState::kFree, CellState::kUnknown,
                                        CellState::kOccupied};
  EXPECT_EQ(states_of(kIndexes), expected);
  EXPECT_EQ(states_of(kProbabilities, 0.001), expected);
  EXPECT_EQ(states_of(kProbabilities, 0.02), std::vector<CellState>(3, CellState::kUnknown));
}

TEST(Compare, TheTruthItselfIsPerfect) {
  const auto truth = drawn({"...# ",  //
                            "..## ",  //
                            "...  "});
  const Detection detection = compare(truth, truth, 5);
  for (const ClassScore& score : {detection.occupied, detection.free}) {
    EXPECT_EQ(score.recall(), 1);
    EXPECT_EQ(score.recall_near(), 1);
    EXPECT_EQ(score.precision(), 1);
    EXPECT_EQ(score.precision_near(), 1);
  }
  EXPECT_EQ(detection.occupied.visible, 3U);
  EXPECT_EQ(detection.free.visible, 8U);
  EXPECT_EQ(detection.missed, 0U);
}

// A wall of four cells, seen one cell too near in its lower half; a false echo far from it.
TEST(Compare, AWallOneCellTooNearIsFoundWithTheTolerance) {
  const auto truth = drawn({".....# ",  //
                            ".....# ",  //
                            ".....# ",  //
                            ".....# "});
  const auto grid = drawn({".....# ",  //
                           "#....# ",  //
                           "....#  ",  //
                           "....#. "});
  const Detection detection = compare(truth, grid, 7);
  EXPECT_EQ(detection.occupied.visible, 4U);
  EXPECT_EQ(detection.occupied.found, 2U);
  EXPECT_EQ(detection.occupied.found_near, 4U);
  EXPECT_EQ(detection.occupied.called, 5U);
  EXPECT_EQ(detection.occupied.right, 2U);
  EXPECT_EQ(detection.occupied.right_near, 4U);
  EXPECT_EQ(detection.free.visible, 20U);
  EXPECT_EQ(detection.free.found, 17U);
  EXPECT_EQ(detection.free.found_near, 20U);
  EXPECT_EQ(detection.free.called, 18U);  // one of them in the wall's place
  EXPECT_EQ(detection.free.right, 17U);
  EXPECT_EQ(detection.missed, 1U);
  EXPECT_EQ(detection.missed_near, 0U);
}

TEST(Compare, APillarThatIsCarvedAwayIsMissed) {
  const auto truth = drawn({"...",  //
                            ".#.",  //
                            "..."});
  const auto grid = drawn({"...",  //
                           "...",  //
                           "..."});
  const Detection detection = compare(truth, grid, 3);
  EXPECT_EQ(detection.missed, 1U);
  EXPECT_EQ(detection.miss_rate(), 1);
  EXPECT_EQ(detection.miss_rate_near(), 1);
  EXPECT_EQ(detection.occupied.recall_near(), 0);
  EXPECT_EQ(detection.occupied.precision(), 0);  // of nothing
  EXPECT_DOUBLE_EQ(detection.free.precision(), 8.0 / 9.0);
}

// The neighbours of a cell at the end of a row do not begin in the next row.
TEST(Compare, NeighboursStayInTheGrid) {
  const auto truth = drawn({"#..",  //
                            "..."});
  const auto grid = drawn({"..#",  //
                           "..#"});
  const Detection detection = compare(truth, grid, 3);
  EXPECT_EQ(detection.occupied.found_near, 0U);
  EXPECT_EQ(detection.occupied.right_near, 0U);
  EXPECT_EQ(detection.missed_near, 1U);
}

TEST(Compare, WhatIsKnownCanBeWrong) {
  const Detection detection = compare(drawn({"....##"}), drawn({"#.  . "}), 6);
  EXPECT_EQ(detection.known_of_free(), 0.5);
  EXPECT_EQ(detection.known_of_occupied(), 0.5);
}

TEST(Compare, FramesAddUp) {
  const auto truth = drawn({".#"});
  Detection sum = compare(truth, drawn({".#"}), 2);
  sum += compare(truth, drawn({".."}), 2);
  EXPECT_EQ(sum.occupied.recall(), 0.5);
  EXPECT_EQ(sum.free.recall(), 1);
  EXPECT_EQ(sum.miss_rate(), 0.5);
}

TEST(EndedCells, CountACellOnce) {
  const auto grid = drawn({"#. ."});
  constexpr std::array<std::uint32_t, 6> kHits{1, 0, 1, 2, 0, 3};
  EndedCells ended = look_up(kHits, grid);
  EXPECT_EQ(ended.occupied, 1U);
  EXPECT_EQ(ended.free, 2U);
  EXPECT_EQ(ended.unknown, 1U);
  EXPECT_EQ(ended.lost(), 0.5);
  EXPECT_EQ(ended.left_unknown(), 0.25);
  ended += look_up({}, grid);
  EXPECT_EQ(ended.all(), 4U);
}

}  // namespace
}  // namespace iog::lab
