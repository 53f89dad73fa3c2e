// Hardware that never answers: every wait ends after as many looks as its source says, and what
// comes behind it is done all the same. A start that hangs would leave the car without eyes.
#include <gtest/gtest.h>
#include <string>

#include "memory/l2_cache.hpp"
#include "port_on_ram.hpp"
#include "time/gpt_clock.hpp"
#include "time/stopwatch.hpp"
#include "time/tick.hpp"
#include "trace.hpp"
#include "uart.hpp"

namespace iog::imx6 {
namespace {

using machine::poke;
using machine::recorder;

// How often a register is looked at.
class DeadHardware : public testing::Test {
 protected:
  DeadHardware() { recorder.reset(); }

  template <typename Register>
  void count_looks_at(const Register& target) {
    recorder.on_load = [this, &target](const void* address) {
      looks_ += address == &target ? 1U : 0U;
    };
  }
  // A bit that the hardware would take back, or set, stays as it is.
  template <typename Register>
  void hold(Register& target, std::uint32_t value) {
    poke(target, value);
    recorder.on_store = [&target, value](const void* address, std::uint32_t /*stored*/) {
      if (address == &target) {
        poke(target, value);
      }
    };
  }

  std::uint32_t looks_ = 0;
};

TEST_F(DeadHardware, AUartThatStaysInResetIsSetUpAllTheSame) {
  UartRegisters registers{};
  Uart uart(registers);
  count_looks_at(registers.ucr2);
  hold(registers.ucr2, 0);
  uart.start();
  EXPECT_EQ(looks_, 100'000U);
  EXPECT_EQ(machine::last_write(registers, 0x84), 0x4027U);
  EXPECT_EQ(machine::writes_to(registers).back(), (machine::Write{0x80, 0x0001}));
}

TEST_F(DeadHardware, ATimerThatStaysInResetIsSetUpAllTheSame) {
  GptRegisters gpt{};
  GptClock clock(gpt);
  count_looks_at(gpt.cr);
  hold(gpt.cr, GptRegisters::kCrSoftReset);
  clock.start();
  EXPECT_EQ(looks_, 1'000U);
  EXPECT_EQ(machine::last_write(gpt, 0x04), 2U);
  EXPECT_EQ(machine::writes_to(gpt).back(), (machine::Write{0x00, 0x034b}));
}

TEST_F(DeadHardware, ATickThatStaysInResetIsSetUpAllTheSame) {
  EpitRegisters epit{};
  Tick tick(epit);
  count_looks_at(epit.cr);
  hold(epit.cr, EpitRegisters::kCrSoftReset);
  tick.start();
  EXPECT_EQ(looks_, 1'000U);
  EXPECT_EQ(machine::last_write(epit, 0x08), 65'999U);
  EXPECT_EQ(machine::writes_to(epit).back(), (machine::Write{0x00, 0x010a'000f}));
}

TEST_F(DeadHardware, ACacheThatNeverDrainsHoldsNobody) {
  Pl310Registers pl310{};
  L2Cache cache(pl310);
  count_looks_at(pl310.cache_sync);
  hold(pl310.cache_sync, 1);
  cache.drain_stores();
  EXPECT_EQ(looks_, 10'000U);
  EXPECT_EQ(recorder.events.back().kind, machine::Event::Kind::kBarrier);
}

// The PL310 says in its own register whether it is on (ARM DDI 0246, 3.3.2): one that a secure
// monitor keeps off is no cache.
TEST_F(DeadHardware, ACacheThatCannotBeSwitchedOnIsTold) {
  Pl310Registers pl310{};
  L2Cache cache(pl310);
  recorder.on_store = [&pl310](const void* address, std::uint32_t /*stored*/) {
    if (address == &pl310.invalidate_by_way || address == &pl310.control) {
      poke(pl310.invalidate_by_way, 0u);
      poke(pl310.control, 0u);
    }
  };
  EXPECT_FALSE(cache.start());
}

// Of a character that the transmitter does not take nothing comes behind, so a line is cut, not
// garbled.
TEST_F(DeadHardware, ATransmitterThatDiesInAWordCutsTheText) {
  for (const auto& [taken, expected] :
       {std::pair{0, ""}, {1, "a"}, {2, "a\r"}, {3, "a\r\n"}, {4, "a\r\nb"}}) {
    recorder.reset();
    UartRegisters registers{};
    Uart uart(registers);
    std::string sent;
    poke(registers.usr1, taken == 0 ? 0 : UartRegisters::kUsr1TransmitReady);
    recorder.on_store = [&, most = static_cast<std::size_t>(taken)](const void* address,
                                                                    std::uint32_t value) {
      if (address == &registers.utxd) {
        sent += static_cast<char>(value);
        poke(registers.usr1, sent.size() < most ? UartRegisters::kUsr1TransmitReady : 0);
      }
    };
    uart.write("a\nb");
    EXPECT_EQ(sent, expected);
  }
}

TEST_F(DeadHardware, FlushWaitsForTheLastBitAndNoLonger) {
  UartRegisters registers{};
  Uart uart(registers);
  recorder.on_load = [&](const void* address) {
    if (address == &registers.usr2 && ++looks_ == 7) {
      poke(registers.usr2, UartRegisters::kUsr2TransmitDone);
    }
  };
  uart.flush();
  EXPECT_EQ(looks_, 7U);
  looks_ = 8;
  poke(registers.usr2, 0U);
  uart.flush();
  EXPECT_EQ(looks_, 100'008U);
}

// Each read takes 100 ns; the stopwatch runs at a rate that the test says.
class Measured : public DeadHardware {
 protected:
  template <typename Rate>
  std::uint32_t mhz_with(Rate&& mhz_at_us) {
    GptRegisters gpt{};
    GlobalTimerRegisters timer{};
    GptClock clock(gpt);
    Stopwatch stopwatch(timer);
    std::uint64_t ticks_ns = 0;  // ticks times 1000
    recorder.on_load = [&](const void* /*address*/) {
      now_ns_ += 100;
      ticks_ns += 100 * std::uint64_t{mhz_at_us(now_ns_ / 1000)};
      poke(gpt.cnt, static_cast<std::uint32_t>(now_ns_ / 1000));
      poke(timer.counter_low, static_cast<std::uint32_t>(ticks_ns / 1000));
    };
    stopwatch.start(clock);
    return stopwatch.ticks_hz() / 1'000'000;
  }

  std::uint64_t now_ns_ = 0;
};

// An emulator that its host puts aside: the first two milliseconds are nonsense.
TEST_F(Measured, ARateIsBelievedWhenTwoMeasurementsAgree) {
  EXPECT_EQ(mhz_with([](std::uint64_t us) { return us < 1'003   ? 900U
                                                   : us < 2'006 ? 40U
                                                                : 396U; }),
            396U);
  EXPECT_LT(now_ns_, 5'100'000U) << "five measurements";
}

TEST_F(Measured, OfARateThatNeverStaysTheLastIsTakenAfterEightTries) {
  EXPECT_GT(mhz_with([](std::uint64_t us) { return 100 + static_cast<std::uint32_t>(us / 10); }),
            800U);
  EXPECT_GT(now_ns_, 8'000'000U);
  EXPECT_LT(now_ns_, 8'100'000U);
}

using DeadPort = PortOnRam;

// The MAC's reset takes eight clocks (IMX6DQRM, ENET_ECR). One that never ends is no reason to
// hang.
TEST_F(DeadPort, APortThatStaysInResetIsSetUpAllTheSame) {
  forget();
  std::uint32_t looks = 0;
  recorder.on_load = [&](const void* address) {
    if (address == &registers_.ecr) {
      ++looks;
      poke(registers_.ecr, machine::peek<std::uint32_t>(registers_.ecr) | EnetRegisters::kEcrReset);
    }
  };
  port_.start(kAddress);
  EXPECT_GE(looks, 1'000U);
  EXPECT_LT(looks, 1'010U);
  EXPECT_EQ(machine::last_write(registers_, 0x144), 0x100U);
}

}  // namespace
}  // namespace iog::imx6
