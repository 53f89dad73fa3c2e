// Starting, waking and stopping of cores 1 to 3: every register write, in order.
#include "cores.hpp"

#include <gtest/gtest.h>

#include "trace.hpp"

namespace iog::imx6 {
namespace {

using hal::CoreState;
using machine::poke;
using machine::recorder;
using machine::Write;
using Kind = machine::Event::Kind;

class CoresOfTheChip : public testing::Test {
 protected:
  static constexpr std::uint32_t kEntry = 0x1010'2000;

  CoresOfTheChip() {
    recorder.reset();
    poke(src_.scr, 0x521u);              // reset value
    poke(scu_.configuration, 0x5'0f3u);  // four cores, all in SMP
    recorder.on_load = [this](const void* address) {
      if (address == &gpt_.cnt) {
        poke(gpt_.cnt, now_us_ += 10);
      }
    };
    // A helper is up as soon as it has left reset.
    recorder.on_store = [this](const void* address, std::uint32_t value) {
      for (std::size_t core = 1; core < hal::kMaxCores; ++core) {
        const bool leaves_reset = address == &src_.scr && (value >> (21 + core) & 1) != 0;
        if (leaves_reset && comes_up_) {
          helpers_[core - 1].state = CoreState::kRunning;
        }
      }
    };
  }

  static void nothing(void*, std::size_t) {}
  bool start(std::size_t core) { return cores_.start(core, {.run = nothing, .context = this}); }

  SrcRegisters src_{};
  ScuRegisters scu_{};
  GicDistributorRegisters distributor_{};
  GptRegisters gpt_{};
  GptClock clock_{gpt_};
  Helpers helpers_{};
  Cores cores_{src_, scu_, distributor_, clock_, helpers_, kEntry};
  std::uint32_t now_us_ = 0;
  bool comes_up_ = true;
};

// ARM DDI 0407, SCU Configuration Register: bits 1:0 are the number of cores less one.
TEST_F(CoresOfTheChip, AreCountedByTheSnoopControlUnit) {
  EXPECT_EQ(cores_.count(), 4U);
  poke(scu_.configuration, 0x10u);
  EXPECT_EQ(cores_.count(), 1U);
  poke(scu_.configuration, 0x31u);
  EXPECT_EQ(cores_.count(), 2U);
}

// IMX6DQRM: SRC_GPR3 at 0x28 has the entry of core 1, GPR4 its argument, GPR5 and 6 those of core
// 2, GPR7 and 8 those of core 3; SRC_SCR bits 22 to 24 enable them, bits 14 to 16 reset them and
// clear themselves, which this memory does not: a reset that still shows is not asked for again.
TEST_F(CoresOfTheChip, StartAtTheirEntryByAResetWhenTheyAreEnabled) {
  ASSERT_TRUE(start(1));
  ASSERT_TRUE(start(2));
  ASSERT_TRUE(start(3));
  const std::vector<Write> expected = {
      {0x00, 0x0000'0521}, {0x28, kEntry}, {0x2c, 0}, {0x00, 0x0040'4521},
      {0x00, 0x0040'0521}, {0x30, kEntry}, {0x34, 0}, {0x00, 0x00c0'8521},
      {0x00, 0x00c0'0521}, {0x38, kEntry}, {0x3c, 0}, {0x00, 0x01c1'0521},
  };
  EXPECT_EQ(machine::writes_to(src_), expected);
}

TEST_F(CoresOfTheChip, LeaveResetAfterEverythingElseIsVisible) {
  ASSERT_TRUE(start(2));
  ASSERT_GE(recorder.events.size(), 2U);
  const machine::Event& last = recorder.events.back();
  EXPECT_EQ(last.address, &src_.scr);
  EXPECT_EQ(recorder.events[recorder.events.size() - 2].kind, Kind::kBarrier);
  EXPECT_EQ(helpers_[1].job.context, this);
}

TEST_F(CoresOfTheChip, ThatALoaderUsedGoThroughReset) {
  poke(src_.scr, 0x0040'0521u);
  ASSERT_TRUE(start(1));
  EXPECT_EQ(machine::writes_to(src_).front(), (Write{0x00, 0x0000'0521}));
}

TEST_F(CoresOfTheChip, AreGivenUpIfTheyDoNotComeUp) {
  comes_up_ = false;
  EXPECT_FALSE(start(1));
  EXPECT_GE(now_us_, 100'000U);
  EXPECT_LT(now_us_, 200'000U);
  EXPECT_EQ(cores_.state(1), CoreState::kOff);
}

// ARM IHI 0048, GICD_SGIR: CPUTargetList in bits 23:16, the number in bits 3:0.
TEST_F(CoresOfTheChip, AreWokenByInterruptZeroWhenTheCountIsVisible) {
  ASSERT_TRUE(start(1));
  ASSERT_TRUE(start(3));
  recorder.events.clear();
  cores_.wake(3);
  EXPECT_EQ(machine::writes_to(distributor_), (std::vector<Write>{{0xf00, 1u << 19}}));
  EXPECT_EQ(recorder.events.front().kind, Kind::kBarrier);
  EXPECT_EQ(helpers_[2].wakes, 1U);
  EXPECT_EQ(helpers_[0].wakes, 0U);
}

TEST_F(CoresOfTheChip, AreStoppedByInterruptOne) {
  ASSERT_TRUE(start(2));
  recorder.events.clear();
  recorder.on_store = [this](const void* address, std::uint32_t) {
    if (address == &distributor_.sgir) {
      helpers_[1].state = CoreState::kStopped;
    }
  };
  EXPECT_TRUE(cores_.stop(2));
  EXPECT_EQ(machine::writes_to(distributor_), (std::vector<Write>{{0xf00, 1u << 18 | 1}}));
}

TEST_F(CoresOfTheChip, AreNotStoppedIfTheyDoNotSaySo) {
  ASSERT_TRUE(start(2));
  EXPECT_FALSE(cores_.stop(2));
  EXPECT_LT(now_us_, 200'000U);
}

TEST_F(CoresOfTheChip, LeaveALastWord) {
  helpers_[0].last_word.text("undefined instruction");
  EXPECT_EQ(cores_.last_word(1), "undefined instruction");
}

}  // namespace
}  // namespace iog::imx6
