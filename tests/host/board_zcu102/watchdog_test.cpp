// The system watchdog by UG1087, module SWDT, on a RAM block: QEMU has none.
#include "watchdog.hpp"

#include <gtest/gtest.h>

#include "trace.hpp"

namespace iog::zcu102 {
namespace {

TEST(Zcu102Watchdog, IsOffWhileItsPeriodChangesAndThenRuns) {
  machine::recorder.reset();
  WatchdogRegisters registers{};
  Watchdog(registers).start();
  // ZMR: key ABC in bits 23:12, RSTLEN in 6:4, RSTEN bit 1, WDEN bit 0. CCR: key 248 in bits 25:14,
  // CRV in 13:2, CLKSEL 3 for 4096. 100 MHz / 4096 are 24,414 Hz: CRV 15, with twelve ones below
  // it, is 65,535 counts, or 2.7 s.
  const std::vector<machine::Write> expected{
      {0x00, 0x00abc030}, {0x04, 0x0092003f}, {0x00, 0x00abc033}, {0x08, 0x1999}};
  EXPECT_EQ(machine::writes_to(registers), expected);
}

TEST(Zcu102Watchdog, IsServicedByTheRestartKey) {
  machine::recorder.reset();
  WatchdogRegisters registers{};
  Watchdog(registers).service();
  EXPECT_EQ(machine::writes_to(registers), (std::vector<machine::Write>{{0x08, 0x1999}}));
}

}  // namespace
}  // namespace iog::zcu102
