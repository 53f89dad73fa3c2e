#include "lab/evaluation/object_scores.hpp"

#include <gtest/gtest.h>

namespace iog::lab {
namespace {

constexpr std::uint64_t kFrameUs = 40'000;
constexpr std::uint32_t kDrawnCar = 1'000'001;

// A car that drives with 8 m/s along x and is told from a frame on, by whatever is given.
class DrawnDrive {
 public:
  // Frames without anything.
  void pass(std::uint32_t frames) {
    for (std::uint32_t i = 0; i < frames; ++i) {
      next({});
    }
  }
  void show(std::uint32_t frames) {
    for (std::uint32_t i = 0; i < frames; ++i) {
      next({.movers = {car()}});
    }
  }
  void show_told(std::uint32_t frames, const Reported& by) {
    for (std::uint32_t i = 0; i < frames; ++i) {
      Mover told = car();
      told.told_by = 0;
      next({.movers = {told}, .reported = {by}});
    }
  }
  void next(ObjectFrame frame) {
    frame.time_us = now_us();
    scorer_.add(frame);
    ++number_;
  }

  [[nodiscard]] std::uint64_t now_us() const { return number_ * kFrameUs; }
  [[nodiscard]] const ObjectScorer& scorer() const { return scorer_; }
  [[nodiscard]] const View& view(std::size_t number = 0) const { return scorer_.views()[number]; }

  static Mover car() { return {.thing = kDrawnCar, .at = {10, 0}, .velocity = {8, 0}}; }

 private:
  ObjectScorer scorer_;
  std::uint32_t number_ = 1;
};

Reported told_as(std::uint32_t id) {
  return {.id = id, .at = {10, 0}, .velocity = {8, 0}, .deviation = 0.5, .on = ReportedOn::kMover};
}

// 6 frames not told, then 14 told: 0.24 s late. From 0.5 s on are the 7 frames from 0.52 s to 0.76
// s.
TEST(ObjectScorer, CountsHowLateAMoverIsTold) {
  DrawnDrive drive;
  drive.show(6);
  drive.show_told(14, told_as(3));
  const View& view = drive.view();
  EXPECT_EQ(view.frames, 20U);
  EXPECT_EQ(view.told, 14U);
  EXPECT_EQ(view.delay_us, 240'000U);
  EXPECT_EQ(view.late_frames, 7U);
  EXPECT_EQ(view.late_told, 7U);
  EXPECT_EQ(view.seen_us, 19 * kFrameUs);
}

TEST(ObjectScorer, AMoverThatIsNeverToldHasNoDelay) {
  DrawnDrive drive;
  drive.show(30);
  EXPECT_FALSE(drive.view().delay_us);
  EXPECT_EQ(drive.view().last_us - drive.view().first_us, 29 * kFrameUs);
  EXPECT_EQ(drive.view().late_frames, 17U);
  EXPECT_EQ(drive.view().late_told, 0U);
}

// A gap of a second is one, of more it is not. Times in a gap of more than 0.2 s are not seen.
TEST(ObjectScorer, AMoverThatWasGoneForMoreThanASecondComesAnew) {
  DrawnDrive drive;
  drive.show_told(5, told_as(3));
  drive.pass(4);
  drive.show(1);
  EXPECT_EQ(drive.view().seen_us, (4 + 5) * kFrameUs);
  drive.pass(24);
  drive.show(1);
  ASSERT_EQ(drive.scorer().views().size(), 1U);
  EXPECT_EQ(drive.view().seen_us, (4 + 5) * kFrameUs);
  drive.pass(25);
  drive.show(3);
  drive.show_told(1, told_as(4));
  ASSERT_EQ(drive.scorer().views().size(), 2U);
  EXPECT_EQ(drive.view(0).frames, 7U);
  EXPECT_EQ(drive.view(0).other_ids, 0U);
  EXPECT_EQ(drive.view(1).delay_us, 3 * kFrameUs);
  EXPECT_EQ(drive.view(1).other_ids, 0U);  // nobody could know it again
}

// 3, not told, 3 again, 5, 5, 3: two times another than before.
TEST(ObjectScorer, CountsIdsThatAreOthers) {
  DrawnDrive drive;
  drive.show_told(1, told_as(3));
  drive.show(2);
  drive.show_told(1, told_as(3));
  drive.show_told(2, told_as(5));
  drive.show_told(1, told_as(3));
  EXPECT_EQ(drive.view().other_ids, 2U);
}

// It is off by 0.6 m/s along and 0.8 across. Known for half a second it is in the 13th frame after
// the one in which it was born.
TEST(ObjectScorer, MeasuresVelocityOfWhatIsKnownForHalfASecond) {
  DrawnDrive drive;
  Reported by = told_as(3);
  by.velocity = {7.4, 0.8};
  by.born_us = drive.now_us();
  by.deviation = 0.51;
  drive.show_told(13, by);
  EXPECT_TRUE(drive.view().errors.empty());
  drive.show_told(1, by);
  by.deviation = 0.49;
  drive.show_told(1, by);
  ASSERT_EQ(drive.view().errors.size(), 2U);
  EXPECT_NEAR(drive.view().errors[0].metres_a_second, 1.0, 1e-12);
  EXPECT_TRUE(drive.view().errors[0].is_within_two_deviations);
  EXPECT_FALSE(drive.view().errors[1].is_within_two_deviations);
}

// A car that is told 1.5 m off, one that is not, something that stands and is said to move, and a
// car that does not count: it is neither wrong nor a part of GOSPA.
TEST(ObjectScorer, CountsWhatIsReportedAndDoesNotMove) {
  DrawnDrive drive;
  Mover told = DrawnDrive::car();
  told.told_by = 1;
  Mover missed{.thing = kDrawnCar + 1, .is_person = true, .at = {0, 30}};
  Reported wrong{.id = 8, .at = {-20, 0}, .on = ReportedOn::kNothing};
  Reported far{.id = 9, .at = {39.5, 0}, .on = ReportedOn::kIgnored};
  Reported right = told_as(3);
  right.at = {10, 1.5};
  drive.next({.movers = {told, missed}, .reported = {wrong, right, far}});
  drive.pass(1);
  const ObjectTotals& totals = drive.scorer().totals();
  EXPECT_EQ(totals.frames, 2U);
  EXPECT_EQ(totals.movers, 2U);
  EXPECT_EQ(totals.reported, 3U);
  EXPECT_EQ(totals.wrong, 1U);
  EXPECT_EQ(totals.gospa.place_m, 1.5);
  EXPECT_EQ(totals.gospa.missed, 1U);
  EXPECT_EQ(totals.gospa.wrong, 1U);
  EXPECT_EQ(totals.gospa.sum_m(ObjectScorer::kCutM), 5.5);
  ASSERT_EQ(drive.scorer().views().size(), 2U);
  EXPECT_TRUE(drive.view(1).is_person);
}

}  // namespace
}  // namespace iog::lab
