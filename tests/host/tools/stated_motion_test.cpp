// Logs whose rows are sound and contradict each other, as those with wrong units or axes do.
#include "tools/poses/stated_motion.hpp"

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>

#include "gtest/gtest.h"

#include "tools/simulate/random.hpp"

namespace iog::tools {
namespace {

// A circle of 50 m to the left at 10 m/s, 10 times a second for half a minute.
std::vector<LoggedPose> circle() {
  std::vector<LoggedPose> poses;
  for (std::size_t i = 0; i < 300; ++i) {
    const double angle = 0.02 * static_cast<double>(i);
    poses.push_back({.time_us = 100'000 * (i + 1),
                     .x_m = 50 * std::sin(angle),
                     .y_m = 50 * (1 - std::cos(angle)),
                     .heading_rad = angle,
                     .speed_mps = 10,
                     .yaw_rate_rps = 0.2});
  }
  return poses;
}

// The notes of a log whose poses are spoilt so.
std::vector<std::string> notes_of(const std::function<void(LoggedPose&)>& spoil,
                                  std::size_t rows = 300) {
  PoseLog log;
  log.poses = circle();
  log.poses.resize(rows);
  for (LoggedPose& pose : log.poses) {
    spoil(pose);
  }
  return converted(std::move(log), {}).notes;
}

std::vector<std::string> contradicted(const std::string& what) {
  return {"the positions contradict the log's " + what + ": check its units, signs and axes"};
}

TEST(StatedMotion, FitsThePositionsOfASoundLog) {
  EXPECT_TRUE(notes_of([](LoggedPose& /*pose*/) {}).empty());
  EXPECT_TRUE(notes_of([](LoggedPose& pose) {
                pose.speed_mps.reset();
                pose.yaw_rate_rps.reset();
              }).empty());
  Random random(1);  // a receiver's noise
  EXPECT_TRUE(notes_of([&](LoggedPose& pose) {
                pose.x_m += random.between(-0.5, 0.5);
                pose.y_m += random.between(-0.5, 0.5);
                pose.heading_rad = *pose.heading_rad + random.between(-0.1, 0.1);
              }).empty());
}

TEST(StatedMotion, ContradictsPositionsInOtherUnitsOrAxes) {
  EXPECT_EQ(notes_of([](LoggedPose& pose) { pose.heading_rad = *pose.heading_rad + 1; }),
            contradicted("headings by 57 degrees"));
  EXPECT_EQ(notes_of([](LoggedPose& pose) { pose.speed_mps = 36; }),
            contradicted("speeds by 260 %"));
  EXPECT_EQ(notes_of([](LoggedPose& pose) { pose.speed_mps = -10; }),
            contradicted("speeds by 200 %"));
  EXPECT_EQ(notes_of([](LoggedPose& pose) { pose.yaw_rate_rps = -0.2; }),
            contradicted("yaw rates by 200 % of the turn"));
  // Radians in a column of degrees, and degrees in one of radians.
  const double degree = std::numbers::pi / 180;
  for (const double wrong : {degree, 1 / degree}) {
    const auto notes =
        notes_of([=](LoggedPose& pose) { pose.heading_rad = *pose.heading_rad * wrong; });
    ASSERT_FALSE(notes.empty());
    EXPECT_TRUE(notes.back().starts_with("the positions contradict the log's headings by "))
        << notes.back();
  }
}

// To and fro on 60 m in 21 s: ahead until 5.2 s, back until 15.7 s.
TEST(StatedMotion, ADriveThatIsBackwardsAlmostAllTheWayIsTold) {
  const auto told_of = [](double from_s, std::size_t rows) {
    return notes_of(
        [=](LoggedPose& pose) {
          const double angle = 0.3 * (from_s + static_cast<double>(pose.time_us) / 1e6);
          pose.x_m = 30 * std::sin(angle);
          pose.y_m = 0;
          pose.heading_rad = 0;
          pose.speed_mps = 9 * std::cos(angle);
          pose.yaw_rate_rps = 0;
        },
        rows);
  };
  const std::vector<std::string> backwards{
      "by the log the car drives backwards on 100 % of its way: if it did not, add 180 degrees to "
      "the headings"};
  EXPECT_EQ(told_of(5.2, 104), backwards);
  EXPECT_TRUE(told_of(5.2, 30).empty());   // 11 m
  EXPECT_TRUE(told_of(2.0, 137).empty());  // 13 m of 73 ahead
  EXPECT_TRUE(told_of(0, 300).empty());
}

TEST(StatedMotion, OfAShortDriveIsNotJudged) {
  const auto spoil = [](LoggedPose& pose) { pose.heading_rad = *pose.heading_rad + 1; };
  EXPECT_TRUE(notes_of(spoil, 20).empty());
  EXPECT_FALSE(notes_of(spoil, 40).empty());
}

// Poses of 1 Hz, and a pause of 3 s in a log of 10 Hz.
TEST(StatedMotion, GapsBetweenPosesAreTold) {
  const auto told = [](const std::string& gaps, const std::string& longest) {
    return std::vector{gaps + " longer than 0.250 s, the longest " + longest +
                       " s: packets in them later than 0.100 s after a pose have no place"};
  };
  const auto later = [](std::uint64_t times, std::uint64_t pause_us) {
    return notes_of([=](LoggedPose& pose) {
      pose.time_us = pose.time_us * times + (pose.time_us > 10'000'000 ? pause_us : 0);
      pose.speed_mps.reset();
      pose.yaw_rate_rps.reset();
    });
  };
  EXPECT_EQ(later(10, 0), told("299 gaps between poses are", "1.000"));
  EXPECT_EQ(later(1, 3'000'000), told("1 gap between poses is", "3.100"));
}

TEST(StatedMotion, PositionsInMillimetresAreTold) {
  const auto notes = notes_of([](LoggedPose& pose) {
    pose.x_m *= 1000;
    pose.y_m *= 1000;
  });
  ASSERT_FALSE(notes.empty());
  EXPECT_EQ(notes[0],
            "no car moves as most poses say: check the units of positions, headings and times");
}

}  // namespace
}  // namespace iog::tools
