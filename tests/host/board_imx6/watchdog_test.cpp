// WDOG1 against the i.MX6DQ manual.
#include "watchdog.hpp"

#include <gtest/gtest.h>

#include "trace.hpp"

namespace iog::imx6 {
namespace {

using machine::recorder;
using machine::Write;

TEST(Watchdog, TellsAHangAfterTwoSecondsAndResetsHalfASecondLater) {
  recorder.reset();
  WatchdogRegisters registers{};
  Watchdog(registers).start();
  const std::vector<Write> expected = {
      {0x08, 0x0000},  // WMCR: power-down counter off
      {0x06, 0x8001},  // WICR: WIE; WICT = 1, half a second before the end
      {0x00, 0x0434},  // WCR: WT = 4 is (4 + 1) half seconds; WDA and SRS inactive; WDE
      {0x02, 0x5555}, {0x02, 0xaaaa},
  };
  EXPECT_EQ(machine::writes_to(registers), expected);
}

TEST(Watchdog, WritesTheWriteOnceBitsOnce) {
  WatchdogRegisters registers{};
  Watchdog watchdog(registers);
  watchdog.start();
  recorder.reset();
  watchdog.start();
  for (const Write& write : machine::writes_to(registers)) {
    EXPECT_NE(write.offset, 0u);
    EXPECT_NE(write.offset, 6u);
  }
}

TEST(Watchdog, GivesALoadersWatchdogItsOwnPeriodAndNoOtherBits) {
  WatchdogRegisters registers{};
  registers.wcr.write(0xff3d);  // 128 s; WDE and WDZST, which can be written once
  recorder.reset();
  Watchdog(registers).start();
  const std::vector<Write> expected = {
      {0x08, 0x0000}, {0x06, 0x8001}, {0x00, 0x043d}, {0x02, 0x5555}, {0x02, 0xaaaa}};
  EXPECT_EQ(machine::writes_to(registers), expected);
}

TEST(Watchdog, ServiceIsTheSequence5555Aaaa) {
  recorder.reset();
  WatchdogRegisters registers{};
  Watchdog(registers).service();
  const std::vector<Write> expected = {{0x02, 0x5555}, {0x02, 0xaaaa}};
  EXPECT_EQ(machine::writes_to(registers), expected);
}

}  // namespace
}  // namespace iog::imx6
