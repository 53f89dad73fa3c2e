#include "tools/poses/log_clock.hpp"

#include "gtest/gtest.h"

namespace iog::tools {
namespace {

// A car that drives at 9 m/s and accelerates by 1 m/s^2, each `period_us` for 200 poses. Behind the
// 100th, `lost` poses are missing and the clock is set.
std::string words_of_log(std::int64_t set_us, std::uint64_t period_us, std::size_t lost = 0,
                         double speed_mps = 9) {
  std::vector<LoggedPose> poses;
  for (std::size_t i = 0; i < 200; ++i) {
    const std::uint64_t true_us = i * period_us;
    const double seconds = static_cast<double>(true_us) / 1e6;
    const auto own_us =
        static_cast<std::int64_t>(1'714'564'800'000'000 + true_us) + (i > 99 ? set_us : 0);
    if (i < 100 || i >= 100 + lost) {
      poses.push_back({.time_us = static_cast<std::uint64_t>(own_us),
                       .x_m = speed_mps * (seconds + 0.05 * seconds * seconds),
                       .place = i + 2});
    }
  }
  return words_of_clock_step(poses, "line");
}

TEST(LogClock, AStepThatThePositionsDoNotShareIsTold) {
  EXPECT_EQ(words_of_log(-500'000, 50'000),
            "the log's clock steps by -0.500 s at line 102, as if it was set, while the positions "
            "run on: no single offset fits. Cut the log there");
  EXPECT_NE(words_of_log(500'000, 50'000).find("steps by 0.500 s at line 102"), std::string::npos);
  EXPECT_NE(words_of_log(-1'000'000, 10'000).find("steps by -1.000 s"), std::string::npos);
  EXPECT_NE(words_of_log(1'000'000, 1'000'000).find("steps by 1.000 s"), std::string::npos);
}

// GPS and TAI to UTC.
TEST(LogClock, AStepBackMayBeLong) {
  EXPECT_NE(words_of_log(-18'000'000, 50'000).find("steps by -18.000 s at line 102"),
            std::string::npos);
  EXPECT_NE(words_of_log(-37'000'000, 100'000).find("steps by -37.000 s"), std::string::npos);
}

TEST(LogClock, LostPosesJitterAndAStandingCarAreNone) {
  EXPECT_EQ(words_of_log(0, 50'000), "");
  EXPECT_EQ(words_of_log(0, 50'000, 10), "");
  EXPECT_EQ(words_of_log(0, 1'000'000, 1), "");
  EXPECT_EQ(words_of_log(40'000, 50'000), "");
  EXPECT_EQ(words_of_log(500'000, 50'000, 0, 0.01), "");
}

}  // namespace
}  // namespace iog::tools
