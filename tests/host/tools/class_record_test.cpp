// Lines by which the classes of two runs are compared.
#include "tools/receive/class_record.hpp"

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/receive/class_statistics.hpp"

namespace iog::tools {
namespace {

std::vector<ClassRecord> some_records() {
  return {{.number = 0,
           .stamp_us = 1'000'680'000,
           .slices = 5,
           .packets_placed = 20,
           .packets_not_placed = 3,
           .causes = 0x21,
           .corner_a = -16,
           .corner_b = -15,
           .tiles = 433,
           .class_crc = 0x0AC01B22,
           .frames_of_time = 2,
           .poses_used = 70,
           .slice_poses = {0x0C1F2A3B, 2, 3, 4, 5}},
          {.number = 1}};
}

TEST(ClassRecord, LinesAreReadBack) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "classes";
  write_class_records(path, some_records());
  EXPECT_FALSE(first_difference(read_class_records(path), some_records()).has_value());
  EXPECT_EQ(line_of(some_records()[0]),
            "0 1000680000 5 20 3 21 -16 -15 433 0ac01b22 2 70 "
            "0c1f2a3b,00000002,00000003,00000004,00000005");
  EXPECT_EQ(line_of(some_records()[1]), "1 0 0 0 0 0 0 0 0 00000000 0 0 -");
  EXPECT_EQ(read_class_records(path)[0].causes, 0x21);
  EXPECT_EQ(read_class_records(path)[0].frames_of_time, 2U);
  EXPECT_THROW(static_cast<void>(read_class_records(path + "_missing")), UsageError);
}

TEST(ClassRecord, ADifferenceSaysWhetherItIsThePlace) {
  auto received = some_records();
  received[0].causes = 0;
  received[1].stamp_us = 7;  // nothing was placed then
  EXPECT_FALSE(first_difference(received, some_records()).has_value());
  received[0].class_crc = 1;
  EXPECT_EQ(first_difference(received, some_records()).value(),
            "classes of frame 0: same slices, other classes: received 00000001 (433 tiles from "
            "-16, -15), expected 0ac01b22 (433 tiles from -16, -15)");
  received[0].packets_placed = 19;
  EXPECT_EQ(first_difference(received, some_records())
                .value()
                .find("classes of frame 0: other slices were placed: received 5 slices up to"),
            0U);
  received = some_records();
  received.pop_back();
  EXPECT_EQ(first_difference(received, some_records()).value(),
            "1 frame with evidence and classes received, 2 expected; the common ones are equal");
}

// A host that stalls between a pose and the next scan has the target close a frame without scans.
TEST(ClassRecord, ADifferenceSaysWhetherTimeWentOnWithoutEvidence) {
  auto received = some_records();
  received[0].frames_of_time = 3;
  EXPECT_FALSE(first_difference(received, some_records()).has_value()) << "equal all the same";
  received[0].class_crc = 1;
  EXPECT_NE(first_difference(received, some_records())
                .value()
                .find("; until then the window's time went on in 3 frames without evidence, "
                      "expected 2; was the host stalled?"),
            std::string::npos);
}

// A target that closes a frame before all of its poses have come extrapolates older ones. That is
// found before the classes that follow from it, and it is no fault of the target.
TEST(ClassRecord, ADifferenceSaysWhetherPosesCameLate) {
  auto received = some_records();
  received[0].slice_poses = {0x0C1F2A3B, 2, 7, 8, 5};
  received[0].poses_used = 68;
  EXPECT_EQ(first_difference(received, some_records()).value(),
            "classes of frame 0: slices 3 to 4 of 5 were placed by other poses; until then 68 "
            "poses had come, of 70: the others came late; was the host stalled?")
      << "although the classes are equal by chance";
  received[0].class_crc = 1;
  EXPECT_EQ(first_difference(received, some_records()).value().find("classes of frame 0: slices"),
            0U);
  received[0].slices = 2;
  EXPECT_NE(first_difference(received, some_records()).value().find("68 poses had come, of 70"),
            std::string::npos)
      << "slices that were not placed at all for it";
}

// The same poses have one result, whatever the host did.
TEST(ClassRecord, OtherPlacesByTheSamePosesAreADefect) {
  auto received = some_records();
  received[0].slice_poses[4] = 7;
  EXPECT_EQ(first_difference(received, some_records()).value(),
            "classes of frame 0: slices 5 to 5 of 5 were placed elsewhere by the same poses");
  received[0].slice_poses.clear();  // the end of the classes was lost, which is told elsewhere
  EXPECT_FALSE(first_difference(received, some_records()).has_value());
}

TEST(ClassRecord, TheWirePosesOfItsSlicesNameTheFrame) {
  GridFrame frame;
  ClassGrid& classes = frame.classes.emplace();
  classes.has_end = true;
  classes.end.slice_count = 2;
  classes.end.slices[0] = {.middle_us = 4'000, .pose = {.x_mm = -1, .y_mm = 2, .heading = 3}};
  classes.end.slices[1] = {.middle_us = 4'000, .pose = {.x_mm = 2, .y_mm = -1, .heading = 3}};
  classes.end.pose_fates[0] = 12;
  const ClassRecord record = class_record_of(frame, 0);
  EXPECT_EQ(record.poses_used, 12U);
  ASSERT_EQ(record.slice_poses.size(), 2U);
  EXPECT_NE(record.slice_poses[0], record.slice_poses[1]);
  classes.end.slices[1] = classes.end.slices[0];
  EXPECT_EQ(class_record_of(frame, 0).slice_poses[1], record.slice_poses[0]);
}

GridFrame frame_of(bool has_evidence, std::uint64_t stamp_us) {
  GridFrame frame;
  frame.header.complete_sensors = has_evidence ? 1 : 0;
  frame.classes.emplace().window.slices_end_us = stamp_us;
  return frame;
}

TEST(ClassStatistics, SlicesLostByPosesAreToldWithWhatToDo) {
  const auto rows_of = [](std::uint32_t jumps, std::uint32_t imprecise) {
    GridFrame frame = frame_of(true, 20);
    frame.classes->has_end = true;
    auto& causes = frame.classes->end.causes;
    causes[0].slices = 100 - jumps - imprecise;
    causes[static_cast<std::size_t>(pose::Cause::kJump)].slices = jumps;
    causes[static_cast<std::size_t>(pose::Cause::kImprecise)].slices = imprecise;
    ClassStatistics statistics;
    statistics.add(frame);
    return statistics.table();
  };
  EXPECT_EQ(rows_of(5, 5).find("POSES?"), std::string::npos);
  const std::string jumps = rows_of(83, 0);
  for (const char* const cause : {"83 % of the slices are lost by jumps", "speeds", "yaw rates",
                                  "units", "noise", "counter-clockwise"}) {
    EXPECT_NE(jumps.find(cause), std::string::npos) << jumps;
  }
  const std::string imprecise = rows_of(0, 100);
  EXPECT_NE(imprecise.find("POSES?                100 % of the slices are lost because the poses "
                           "state standard deviations above 150 mm or 3 mrad in a second; for a "
                           "log that is better than it states, --poses-sigma MM MRAD says so"),
            std::string::npos)
      << imprecise;
}

TEST(ClassRecord, CountsFramesInWhichOnlyTimeWentOn) {
  ClassStatistics statistics;
  statistics.add(frame_of(false, 10));  // nothing has been seen yet
  statistics.add(frame_of(true, 20));
  statistics.add(frame_of(false, 20));  // silence altogether
  statistics.add(frame_of(true, 30));
  statistics.add(frame_of(false, 40));
  statistics.add(frame_of(false, 50));
  statistics.add(frame_of(true, 60));
  ASSERT_EQ(statistics.records().size(), 3U);
  EXPECT_EQ(statistics.records()[0].frames_of_time, 0U);
  EXPECT_EQ(statistics.records()[1].frames_of_time, 0U);
  EXPECT_EQ(statistics.records()[2].frames_of_time, 2U);
}

// docs/spec.md 5.2 and 5.5: no message, none that may be used, none of that time, other causes.
TEST(ClassStatistics, SayWhyNothingHadAPlace) {
  const auto told = [](std::uint32_t used, std::uint32_t damaged, std::uint32_t late,
                       std::uint32_t imprecise) {
    GridFrame frame = frame_of(true, 10);
    stream::ClassEnd& end = frame.classes->end;
    frame.classes->has_end = true;
    end.pose_fates[static_cast<std::size_t>(pose::Fate::kUsed)] = used;
    end.pose_fates[static_cast<std::size_t>(pose::Fate::kDamaged)] = damaged;
    end.causes[static_cast<std::size_t>(pose::Cause::kLate)].slices = late;
    end.causes[static_cast<std::size_t>(pose::Cause::kImprecise)].slices = imprecise;
    ClassStatistics statistics;
    statistics.add(frame);
    return statistics.why_nothing_placed(15'010);
  };
  EXPECT_EQ(told(0, 0, 9, 0),
            "no pose message came on UDP port 15010; --poses takes a log of them");
  EXPECT_EQ(told(0, 7, 9, 0), "none of the 7 pose messages on UDP port 15010 was used: 7 damaged");
  EXPECT_EQ(told(5, 7, 9, 0),
            "the poses and the scans do not overlap in time: of 9 slices of scans none has a pose "
            "within 100 ms; are their clocks the same?");
  EXPECT_EQ(told(5, 0, 1, 8), "its slices were not placed: 1 late, 8 imprecise");
}

}  // namespace
}  // namespace iog::tools
