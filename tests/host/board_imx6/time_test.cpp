// GPT clock, stopwatch and tick, with a counter that runs while it is read.
#include <gtest/gtest.h>

#include "time/gpt_clock.hpp"
#include "time/stopwatch.hpp"
#include "time/tick.hpp"
#include "trace.hpp"

namespace iog::imx6 {
namespace {

using machine::poke;
using machine::recorder;
using machine::Write;

// A register whose software reset bit clears itself.
template <typename Register>
auto self_clearing(Register& target, std::uint32_t reset_bit) {
  return [&target, reset_bit](const void* address, std::uint32_t value) {
    if (address == &target && (value & reset_bit) != 0) {
      poke(target, 0u);
    }
  };
}

class Time : public testing::Test {
 protected:
  Time() { recorder.reset(); }

  GptRegisters gpt_{};
  GptClock clock_{gpt_};
};

TEST_F(Time, TheGptCountsMicrosecondsOfTheCrystal) {
  recorder.on_store = self_clearing(gpt_.cr, GptRegisters::kCrSoftReset);
  clock_.start();
  const std::vector<Write> expected = {
      {0x00, 0x0000},  // off
      {0x0c, 0x0000},  // no interrupts
      {0x00, 0x8000},  // software reset
      {0x08, 0x003f},  // all events cleared
      {0x04, 2},       // 3 MHz / (2 + 1)
      {0x00, 0x034a},  // FRR, CLKSRC = 5, WAITEN, ENMOD
      {0x00, 0x034b},  // and only then EN
  };
  EXPECT_EQ(machine::writes_to(gpt_), expected);
}

// Linux, clk-imx6q.c: "gpt_3m clock is not available on i.MX6Q TO1.0". 66 MHz / 66.
TEST_F(Time, OfTheFirstRevisionTheGptCountsThePeripheralClock) {
  recorder.on_store = self_clearing(gpt_.cr, GptRegisters::kCrSoftReset);
  clock_.start(GptSource::kPeripheral);
  EXPECT_EQ(machine::last_write(gpt_, 0x04), 65u);
  EXPECT_EQ(machine::last_write(gpt_, 0x00), 0x024bu);  // FRR, CLKSRC = 1, WAITEN, ENMOD, EN
}

// USB_ANALOG_DIGPROG: NXP's AN12263 has 0x00630005 for revision 1.3 of the i.MX6D/Q; 0x00630100 is
// the i.MX6QP.
TEST(GptSource, OnlyRevisionOneZeroHasNoCrystal) {
  AnalogRegisters analog{};
  poke(analog.digprog, 0x0063'0000u);
  EXPECT_EQ(gpt_source(analog), GptSource::kPeripheral);
  for (const std::uint32_t later : {0x0063'0001u, 0x0063'0002u, 0x0063'0005u, 0x0063'0100u}) {
    poke(analog.digprog, later);
    EXPECT_EQ(gpt_source(analog), GptSource::kCrystal);
  }
}

TEST_F(Time, TheClockGoesOnWhenTheCounterWraps) {
  poke(gpt_.cnt, 0xffff'ffffu);
  EXPECT_EQ(clock_.now_us(), 0xffff'ffffu);
  poke(gpt_.cnt, 5u);
  EXPECT_EQ(clock_.now_us(), 0x1'0000'0005u);
  EXPECT_EQ(clock_.now_us(), 0x1'0000'0005u);
  poke(gpt_.cnt, 4u);
  EXPECT_EQ(clock_.now_us(), 0x2'0000'0004u);
}

class StopwatchAt : public Time, public testing::WithParamInterface<std::uint32_t> {};

// Each read of either counter takes 100 ns of a world in which the stopwatch runs at the given
// rate.
TEST_P(StopwatchAt, MeasuresItsOwnRate) {
  GlobalTimerRegisters timer{};
  std::uint64_t now_ns = 0;
  recorder.on_load = [&](const void*) {
    now_ns += 100;
    poke(gpt_.cnt, static_cast<std::uint32_t>(now_ns / 1000));
    poke(timer.counter_low, static_cast<std::uint32_t>(now_ns * GetParam() / 1000));
  };
  Stopwatch stopwatch(timer);
  stopwatch.start(clock_);
  EXPECT_EQ(machine::last_write(timer, 0x08), 1u);
  EXPECT_EQ(stopwatch.ticks_hz(), GetParam() * 1'000'000);
  EXPECT_LT(now_ns, 9'000'000u) << "calibration is bounded";
}

INSTANTIATE_TEST_SUITE_P(Rates, StopwatchAt, testing::Values(100, 198, 396, 498));

TEST_F(Time, AClockThatStandsStillGivesNoRateAndNoHang) {
  GlobalTimerRegisters timer{};
  poke(gpt_.cnt, 1u);
  Stopwatch stopwatch(timer);
  EXPECT_EQ(stopwatch.ticks_hz(), 0u);
}

TEST(Tick, IsOneMillisecondOfTheSixtySixMegahertz) {
  recorder.reset();
  EpitRegisters epit{};
  recorder.on_store = self_clearing(epit.cr, EpitRegisters::kCrSoftReset);
  Tick tick(epit);
  tick.start();
  const std::vector<Write> expected = {
      {0x00, 0x0000'0000},                       // off
      {0x00, 0x0001'0000},                       // software reset
      {0x00, 0x010a'000a},                       // CLKSRC = 1, WAITEN, IOVW, RLD, ENMOD
      {0x04, 0x0000'0001},                       // event cleared
      {0x08, 65'999},                            // 66 MHz / 1 kHz - 1
      {0x0c, 0},           {0x00, 0x010a'000f},  // OCIEN and EN together
  };
  EXPECT_EQ(machine::writes_to(epit), expected);
  recorder.reset();
  tick.clear();
  EXPECT_EQ(machine::writes_to(epit), (std::vector<Write>{{0x04, 1}}));
}

}  // namespace
}  // namespace iog::imx6
