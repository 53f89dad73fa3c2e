// What the table and its facts say of the objects of a run.
#include "tools/receive/object_statistics.hpp"

#include <map>

#include "gtest/gtest.h"

#include "tools/receive/run_statistics.hpp"

namespace iog::tools {
namespace {

using stream::ObjectState;

GridFrame frame_of(const std::vector<std::pair<std::uint32_t, ObjectState>>& objects) {
  GridFrame frame;
  frame.header.flags = stream::kFlagObjects;
  frame.header.complete_sensors = 1;
  stream::ObjectList& list = frame.objects.emplace();
  list.time_us = 0x0102;
  list.hits_left = 5;
  for (const auto& [id, state] : objects) {
    list.records.at(list.count++) = {.id = id, .state = state};
  }
  return frame;
}

TEST(ObjectStatistics, SayHowManyMove) {
  RunStatistics statistics;
  statistics.add(frame_of({{1, ObjectState::kMoves}, {2, ObjectState::kMoves}}));
  statistics.add(frame_of({{2, ObjectState::kStopped},
                           {3, ObjectState::kMoves},
                           {4, ObjectState::kYoung},
                           {5, ObjectState::kStands}}));
  GridFrame lost = frame_of({});
  lost.objects.reset();
  statistics.add(lost);
  GridFrame nowhere = frame_of({});
  nowhere.objects->time_us = 0;
  statistics.add(nowhere);
  statistics.add(GridFrame{});  // of a target that looks for none

  const Facts facts = statistics.facts();
  std::map<std::string, std::string> values(facts.begin(), facts.end());
  EXPECT_EQ(values["object_frames"], "4");
  EXPECT_EQ(values["object_frames_incomplete"], "1");
  EXPECT_EQ(values["object_frames_without_place"], "1");
  EXPECT_EQ(values["objects_moving"], "3");
  EXPECT_EQ(values["objects_stopped"], "1");
  EXPECT_EQ(values["objects_young"], "1");
  EXPECT_EQ(values["objects_standing"], "1");
  EXPECT_EQ(values["objects_moving_most"], "2");
  EXPECT_EQ(values["objects_that_moved"], "3");
  EXPECT_EQ(values["objects_hits_left"], "15");
  const std::string table = statistics.table(false);
  EXPECT_NE(table.find("1 young, 1 standing, 3 moving, 1 stopped"), std::string::npos) << table;
  EXPECT_NE(table.find("3, at most 2 in a frame"), std::string::npos) << table;
  EXPECT_NE(table.find("1 frame incomplete, 1 without a place"), std::string::npos) << table;
}

TEST(ObjectStatistics, SayNothingWithoutObjects) {
  RunStatistics statistics;
  statistics.add(GridFrame{});
  EXPECT_EQ(statistics.table(false).find("object"), std::string::npos);
}

// CRC-32 of zlib over 00 00 00 00 00 00 01 02, 00 00 00 07, 01, three zeros, 20 zeros, four FF,
// six zeros, two FF.
TEST(ObjectStatistics, AListHasAName) {
  EXPECT_EQ(crc_of(*frame_of({}).objects), 0U);
  EXPECT_EQ(crc_of(*frame_of({{7, ObjectState::kYoung}}).objects), 0xC3A1865DU);
}

}  // namespace
}  // namespace iog::tools
