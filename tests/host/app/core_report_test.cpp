// What the console says of the cores.
#include "app/core_report.hpp"

#include <gtest/gtest.h>
#include <string>

#include "fakes/scripted_cores.hpp"

namespace iog::app {
namespace {

struct Lines {
  std::string text{};
  void write(std::string_view part) { text += part; }
};

class CoreReport : public testing::Test {
 protected:
  static constexpr std::uint32_t kPatienceUs = 1000;

  std::string report() {
    Lines lines;
    report_cores(lines, team_);
    return lines.text;
  }

  // Two items, which core 0 does alone, because no other core does anything.
  void share() {
    int items = 0;
    auto count = [&items](std::size_t /*item*/, std::size_t core) { items += core == 0 ? 1 : 0; };
    team_.share(2, work::work_of(count));
    EXPECT_EQ(items, 2);
  }

  tests::ScriptedCores cores_{.machine_has = 4};
  work::Team<tests::ScriptedCores> team_{cores_, kPatienceUs};
};

TEST_F(CoreReport, CountsThoseAtWorkAndIsSilentAboutThoseThatNobodyWanted) {
  EXPECT_EQ(team_.start(3), 3U);
  EXPECT_EQ(report(), "cores: 3 at work\n");
}

TEST_F(CoreReport, SaysWhyACoreIsLost) {
  cores_.comes_up[1] = false;
  EXPECT_EQ(team_.start(4), 3U);
  EXPECT_EQ(team_.troubles(), 0U);
  cores_.states[2] = hal::CoreState::kFaulted;
  share();
  EXPECT_EQ(team_.troubles(), 1U);
  EXPECT_EQ(report(), "cores: 2 at work\ncore 1 did not come up: \ncore 2 faulted: data abort\n");
}

// Until a whole patience has passed nothing is said, and then once.
TEST_F(CoreReport, SaysOnceThatACoreIsSilent) {
  team_.start(2);
  share();
  cores_.time_us += kPatienceUs;
  share();
  EXPECT_EQ(report(), "cores: 2 at work\n");
  cores_.time_us += 1;
  share();
  EXPECT_EQ(report(), "cores: 2 at work\ncore 1 is silent: \n");
  cores_.time_us += 10ULL * kPatienceUs;
  share();
  EXPECT_EQ(team_.troubles(), 1U);
}

}  // namespace
}  // namespace iog::app
