// Times of points, of which a few are none.
#include <array>
#include <limits>

#include "cloud_bytes.hpp"

namespace iog::tools {
namespace {

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kPoints = 200;

// Points at 1 m, 2 m and so on within a tenth of a second; every so manieth has a strange time.
SeenCloud cloud_with(double strange, double base, std::uint32_t every, TimeUnit& unit) {
  Bytes bytes;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    add(bytes, 1.0 + i);
    add(bytes, 0.0);
    add(bytes, i % every == 1 ? strange : base + 0.1 * i / kPoints);
  }
  CloudRecords records{.count = kPoints, .bytes = bytes, .stamp_us = 1'700'000'000'500'000};
  for (const char* name : {"x", "y", "timestamp"}) {
    records.fields.push_back(
        {.name = name, .bytes = 8, .at = 8 * records.fields.size(), .stride = 24});
  }
  return cloud_of(records, unit, "it");
}

// When such a point was seen is not known, so it is left out, as one whose place is no number.
TEST(PointTimes, AFewPointsWithoutATimeAreLeftOut) {
  for (const double base : {1'700'000'000.5, 100.0, 0.0}) {
    for (const double strange : {kNever, 0.0, 1e300, -1e18}) {
      for (const TimeUnit given : {TimeUnit::kFound, TimeUnit::kSeconds}) {
        TimeUnit unit = given;
        const SeenCloud cloud = cloud_with(strange, base, 50, unit);
        const std::size_t bad = base == 0 && strange == 0 ? 0 : 4;  // 0 may be the scan's begin
        EXPECT_EQ(unit, TimeUnit::kSeconds);
        EXPECT_TRUE(cloud.has_times) << base << ' ' << strange;
        EXPECT_EQ(cloud.untimed, bad) << base << ' ' << strange;
        ASSERT_EQ(cloud.points.size(), kPoints - bad);
        EXPECT_EQ(cloud.points[100].third, bad == 0 ? 101'000 : 104'000);
        EXPECT_NEAR(cloud.points[100].after_us, bad == 0 ? 50'000 : 51'500, 1);
      }
    }
  }
}

// The stamp is 1'700'000'000.5: a stamp at a scan's end is no other clock.
TEST(PointTimes, ThoseOfAnotherClockAreTold) {
  TimeUnit unit = TimeUnit::kSeconds;
  for (const double base : {0.0, 1'700'000'000.5, 1'700'000'000.4, -0.1}) {
    EXPECT_EQ(cloud_with(0, base, kPoints + 1, unit).apart_us, 0) << base;
  }
  EXPECT_NEAR(cloud_with(0, 1'700'000'037.5, kPoints + 1, unit).apart_us, 37e6, 1e3);
  EXPECT_NEAR(cloud_with(0, 1'699'999'990.5, kPoints + 1, unit).apart_us, 10e6, 1e3);
  EXPECT_NEAR(cloud_with(0, 100, kPoints + 1, unit).apart_us, 100e6, 1e3);
  EXPECT_EQ(words_of_other_clock(37e6),
            "points' times are 37.0 s from their clouds' stamps; each cloud's first point is put "
            "at its stamp");
}

// Scans of 0.1 s, ten a second: 1.5 times a second's tenth is the most that a stamp's delay
// explains.
TEST(PointTimes, AWrongUnitIsTold) {
  EXPECT_EQ(words_of_wrong_unit(TimeUnit::kNanoseconds, 0.1, 100'000),
            "with --time-unit ns a scan lasts 0.1 ns, not 5 to 500 ms: try --time-unit s");
  EXPECT_EQ(words_of_wrong_unit(TimeUnit::kNanoseconds, 99'000, 100'000),
            "with --time-unit ns a scan lasts 99000 ns, not 5 to 500 ms: try --time-unit us");
  EXPECT_NE(words_of_wrong_unit(TimeUnit::kMilliseconds, 0.033, 100'000), "")
      << "a third of a turn";
  EXPECT_EQ(words_of_wrong_unit(TimeUnit::kSeconds, 0.1, 100'000), "");
  EXPECT_EQ(words_of_wrong_unit(TimeUnit::kSeconds, 0.001, 100'000), "") << "a flash";
  EXPECT_EQ(words_of_wrong_unit(TimeUnit::kNanoseconds, 100'000, 100), "") << "a part of a scan";
  EXPECT_EQ(words_of_wrong_unit(TimeUnit::kNanoseconds, 0.1, 0), "") << "one cloud";
  EXPECT_EQ(words_of_wrong_unit(TimeUnit::kNanoseconds, 0, 100'000), "") << "no times";
  EXPECT_EQ(words_of_wrong_unit(TimeUnit::kFound, 0.1, 100'000), "");
}

TEST(PointTimes, ManyWithoutATimeAreTold) {
  TimeUnit unit = TimeUnit::kSeconds;
  EXPECT_EQ(told_by([&] { static_cast<void>(cloud_with(0, 100, 5, unit)); }),
            "it: its points are more than a second apart");
}

TEST(PointTimes, IfMostHaveNoneAllPointsAreKept) {
  TimeUnit unit = TimeUnit::kFound;
  const SeenCloud cloud = cloud_with(0, kNever, kPoints + 1, unit);
  EXPECT_FALSE(cloud.has_times);
  EXPECT_EQ(cloud.points.size(), kPoints);
}

}  // namespace
}  // namespace iog::tools
