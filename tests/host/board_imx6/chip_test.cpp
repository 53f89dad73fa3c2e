// What is set once at start: GIC, clocks, L2 cache, pads.
#include <gtest/gtest.h>
#include <memory>

#include "clocks.hpp"
#include "gic.hpp"
#include "memory/l2_cache.hpp"
#include "pins.hpp"
#include "trace.hpp"

namespace iog::imx6 {
namespace {

using machine::last_write;
using machine::peek;
using machine::poke;
using machine::recorder;
using machine::Write;

TEST(Gic, LetsExactlyTheFourLinesThrough) {
  recorder.reset();
  GicDistributorRegisters distributor{};
  GicCpuRegisters cpu{};
  start_gic(distributor, cpu);
  std::vector<Write> enabled;
  for (const Write& write : machine::writes_to(distributor)) {
    if (write.offset >= 0x100 && write.offset < 0x180) {
      enabled.push_back(write);
    }
  }
  // UART1 is 58 = 32 + 26, EPIT1 is 88 = 2 * 32 + 24, WDOG1 112 = 3 * 32 + 16, ENET 150 = 4 * 32 +
  // 22 (IMX6DQRM, table "ARM domain interrupts").
  EXPECT_EQ(enabled,
            (std::vector<Write>{
                {0x104, 1u << 26}, {0x108, 1u << 24}, {0x110, 1u << 22}, {0x10c, 1u << 16}}));
  EXPECT_EQ(last_write(distributor, 0x800 + 112), 1u);
  EXPECT_EQ(last_write(distributor, 0x800 + 58), 1u);
  EXPECT_EQ(last_write(distributor, 0x800 + 88), 1u);
  EXPECT_EQ(last_write(distributor, 0x800 + 150), 1u);
}

TEST(Gic, DisablesWhatALoaderLeftAndEnablesItselfLast) {
  recorder.reset();
  GicDistributorRegisters distributor{};
  GicCpuRegisters cpu{};
  start_gic(distributor, cpu);
  const std::vector<Write> writes = machine::writes_to(distributor);
  EXPECT_EQ(writes.front(), (Write{0x000, 0}));
  EXPECT_EQ(writes.back(), (Write{0x000, 3}));
  for (std::size_t word = 0; word < 5; ++word) {
    EXPECT_EQ(last_write(distributor, 0x180 + 4 * word), 0xffff'ffffu);
    EXPECT_EQ(last_write(distributor, 0x280 + 4 * word), 0xffff'ffffu);
  }
  // Both groups, and FIQEn (bit 3), which makes fast interrupts of group 0.
  EXPECT_EQ(machine::writes_to(cpu), (std::vector<Write>{{0x00, 0}, {0x04, 0xff}, {0x00, 0xb}}));
}

// ARM IHI 0048, GICD_IGROUPR: a zero is group 0. What only wakes must not come as a fast interrupt.
TEST(Gic, TheWatchdogsAloneIsAFastInterrupt) {
  recorder.reset();
  GicDistributorRegisters distributor{};
  GicCpuRegisters cpu{};
  start_gic(distributor, cpu);
  for (std::size_t word = 0; word < 5; ++word) {
    EXPECT_EQ(last_write(distributor, 0x080 + 4 * word), word == 3 ? ~(1u << 16) : 0xffff'ffffu);
  }
  // A core is told of the most urgent one alone, which is the lowest number (3.3, "Interrupt
  // prioritization").
  for (const std::size_t other : {58u, 88u, 150u}) {
    EXPECT_LT(last_write(distributor, 0x400 + 112), last_write(distributor, 0x400 + other));
  }
}

TEST(Clocks, OpenTheGatesAndKeepWfiFromStoppingTheBuses) {
  recorder.reset();
  CcmRegisters ccm{};
  poke(ccm.cscdr1, 0x0049'0b01u);
  poke(ccm.clpcr, 0x79u);  // reset value: LPM = WAIT
  start_clocks(ccm);
  EXPECT_EQ(peek<std::uint32_t>(ccm.clpcr), 0x78u);
  EXPECT_EQ(peek<std::uint32_t>(ccm.cscdr1), 0x0049'0b00u);
  EXPECT_EQ(peek<std::uint32_t>(ccm.ccgr[1]), 0x00f0'3c00u);
  EXPECT_EQ(peek<std::uint32_t>(ccm.ccgr[2]), 0x0000'f000u);
  EXPECT_EQ(peek<std::uint32_t>(ccm.ccgr[5]), 0x0f00'0000u);
}

class L2 : public testing::Test {
 protected:
  L2() { recorder.reset(); }

  Pl310Registers registers_{};
  L2Cache cache_{registers_};
};

TEST_F(L2, IsConfiguredWhileOffInvalidatedAndThenOn) {
  recorder.on_store = [this](const void* address, std::uint32_t) {
    if (address == &registers_.invalidate_by_way) {
      poke(registers_.invalidate_by_way, 0u);  // done at once
    }
  };
  EXPECT_TRUE(cache_.start());
  std::vector<Write> expected = {
      {0x100, 0}, {0x108, 0x132},       {0x10c, 0x132}, {0x104, 1u << 22},
      {0xf60, 0}, {0xf60, 0x3000'0000}, {0xf80, 2},     {0x214, 0},
  };
  // No way is locked, for any master: a loader may have left other values.
  for (const std::size_t kind : {0x900u, 0x904u}) {
    for (std::size_t master = 0; master < 8; ++master) {
      expected.push_back({kind + 8 * master, 0});
    }
  }
  expected.insert(expected.end(), {{0x77c, 0xffff}, {0x730, 0}, {0x100, 1}});
  EXPECT_EQ(machine::writes_to(registers_), expected);
}

// ARM DDI 0246, 3.3.9: a set bit of a data lockdown register keeps data out of its way.
// Instructions may use all ways.
TEST_F(L2, KeepsFourteenOfSixteenWaysUntilTold) {
  recorder.reset();
  cache_.keep(true);
  cache_.keep(false);
  std::vector<Write> expected;
  for (const std::uint32_t locked : {0x3fffu, 0u}) {
    for (std::size_t master = 0; master < 8; ++master) {
      expected.push_back({0x900 + 8 * master, locked});
    }
  }
  EXPECT_EQ(machine::writes_to(registers_), expected);
}

// ARM DDI 0246, Auxiliary Control Register: lines of zeros in one write (bit 0) and exclusive
// caches (bit 12) must be set in the cores' ACTLR as well, which core_start.S writes without them.
// The size of the ways (bits 19:17) and what else a loader has chosen stays.
TEST_F(L2, ForgetsWhatTheCoresWouldHaveToAgreeWith) {
  poke(registers_.aux_control, 0x3247'1001u);
  static_cast<void>(cache_.start());
  EXPECT_EQ(last_write(registers_, 0x104), 0x3247'0000u);
}

TEST_F(L2, StaysOffIfInvalidatingNeverEnds) {
  EXPECT_FALSE(cache_.start());
  EXPECT_EQ(last_write(registers_, 0x100), 0u);
}

TEST_F(L2, DrainingIsABarrierASyncAndABarrier) {
  cache_.drain_stores();
  using Kind = machine::Event::Kind;
  ASSERT_EQ(recorder.events.size(), 3u);
  EXPECT_EQ(recorder.events[0].kind, Kind::kBarrier);
  EXPECT_EQ(recorder.events[1].address, &registers_.cache_sync);
  EXPECT_EQ(recorder.events[2].kind, Kind::kBarrier);
}

class Pins : public testing::Test {
 protected:
  Pins() {
    recorder.reset();
    recorder.on_load = [this](const void* address) {
      if (address == &gpt_.cnt) {
        poke(gpt_.cnt, ++now_us_);
      }
    };
    // When the reset pin rises, the world is written down: that is when the PHY reads its straps.
    recorder.on_store = [this](const void* address, std::uint32_t value) {
      if (address == &gpio3_.dr && (value & kReset) != 0) {
        straps_ = peek<std::uint32_t>(gpio6_.dr) & peek<std::uint32_t>(gpio6_.gdir);
        strap_alternative_ = peek<std::uint32_t>(iomuxc_->at(0x084));
        released_us_ = now_us_;
      }
    };
  }

  static constexpr std::uint32_t kReset = 1u << 23;

  std::unique_ptr<IomuxcRegisters> iomuxc_ = std::make_unique<IomuxcRegisters>();
  GpioRegisters gpio3_{};
  GpioRegisters gpio6_{};
  GptRegisters gpt_{};
  GptClock clock_{gpt_};
  std::uint32_t now_us_ = 0;
  std::uint32_t straps_ = 0;
  std::uint32_t strap_alternative_ = 0;
  std::uint32_t released_us_ = 0;
};

TEST_F(Pins, ThePhyLeavesResetAfterTenMillisecondsWithItsStrapsHigh) {
  start_ethernet_pins(*iomuxc_, gpio3_, gpio6_, clock_);
  EXPECT_EQ(machine::writes_to(gpio3_).front(), (Write{0x00, 0}));
  EXPECT_GE(released_us_, 10'000u);
  EXPECT_EQ(straps_, 0x7b00'0000u);  // GPIO6: 24, 25, 27, 28, 29, 30
  EXPECT_EQ(strap_alternative_, 5u);
  EXPECT_GE(now_us_ - released_us_, 100u);
}

TEST_F(Pins, AfterwardsTheStrapsAreRgmiiAndNoLongerDriven) {
  start_ethernet_pins(*iomuxc_, gpio3_, gpio6_, clock_);
  EXPECT_EQ(peek<std::uint32_t>(gpio6_.gdir), 0u);
  for (const std::uint32_t mux : {0x84u, 0x70u, 0x78u, 0x7cu, 0x80u, 0x6cu, 0x58u, 0x5cu, 0x60u,
                                  0x64u, 0x68u, 0x74u, 0x1d0u, 0x1f4u, 0x1d4u}) {
    EXPECT_EQ(peek<std::uint32_t>(iomuxc_->at(mux)), 1u) << std::hex << mux;
  }
  EXPECT_EQ(peek<std::uint32_t>(iomuxc_->at(0x398)), 0x1'b030u);
  EXPECT_EQ(peek<std::uint32_t>(iomuxc_->at(0x4e4)), 0x1'b0b0u);
}

TEST_F(Pins, TheConsoleIsOnEimD26AndD27) {
  start_console_pins(*iomuxc_);
  const std::vector<Write> expected = {
      {0x0bc, 4}, {0x3d0, 0x1'b0b1}, {0x0c0, 4}, {0x3d4, 0x1'b0b1}, {0x928, 1}};
  EXPECT_EQ(machine::writes_to(*iomuxc_), expected);
}

TEST_F(Pins, TheLineOfTheGridIsOnSd3Dat7AndDat6) {
  start_serial_pins(*iomuxc_);
  const std::vector<Write> expected = {
      {0x2a8, 1}, {0x690, 0x1'b0b1}, {0x2ac, 1}, {0x694, 0x1'b0b1}, {0x920, 3}};
  EXPECT_EQ(machine::writes_to(*iomuxc_), expected);
}

}  // namespace
}  // namespace iog::imx6
