// The Ethernet port starts anew: after a bus error, when a frame never leaves, and when the link
// has another speed or duplex. By IMX6DQRM, chapter "10/100/1000-Mbps Ethernet MAC (ENET)":
// EIR.EBERR, ECR.RESET, TCR.FDEN.
#include <algorithm>
#include <gtest/gtest.h>
#include <set>
#include <vector>

#include "port_on_ram.hpp"

namespace iog::imx6 {
namespace {

using machine::peek;
using machine::poke;
using machine::Write;

constexpr std::uint32_t kBusError = 1u << 22;
constexpr std::uint16_t kFull100 = 0x0100 | 1;
constexpr std::uint16_t kHalf100 = 0x0080 | 1;
constexpr std::uint16_t kFull10 = 0x0040 | 1;
constexpr std::uint16_t kGigabitFull = 0x0800;

class Restart : public PortOnRam {
 protected:
  [[nodiscard]] std::uint32_t restarts() const { return port_.counters().restarts; }

  // Everything that is written while a link comes up, but for MDIO and events.
  std::vector<Write> writes_when_up(std::uint16_t partner, std::uint16_t gigabit_status) {
    forget();
    link_up(0, partner, gigabit_status);
    std::vector<Write> writes = machine::writes_to(registers_);
    std::erase_if(writes, [](const Write& write) {
      return write.offset == 0x040 || (write.offset == 0x004 && write.value != 0xffff'ffff);
    });
    return writes;
  }
};

TEST_F(Restart, AGigabitLinkStopsResetsAndStartsTheControllerAgain) {
  const std::uint32_t receive = machine::bus_address(receive_[0]);
  const std::uint32_t transmit = machine::bus_address(transmit_[0]);
  EXPECT_EQ(writes_when_up(kFull100, kGigabitFull),
            (std::vector<Write>{
                {0x008, 0},                                              // EIMR
                {0x024, 0x100},                                          // ECR, stops
                {0x024, 1},                                              // resets
                {0x004, 0xffff'ffff},                                    // EIR
                {0x064, 0xa000'0000},                                    // MIBC, cleared
                {0x064, 0x8000'0000}, {0x064, 0}, {0x0e4, 0x0211'2233},  // PALR
                {0x0e8, 0x4455'8808},                                    // PAUR
                {0x118, 0},                                              // IAUR
                {0x11c, 0},                                              // IALR
                {0x120, 0},                                              // GAUR
                {0x124, 0},                                              // GALR
                {0x0ec, 0x0001'0020},                                    // OPD
                {0x188, 2032},                                           // MRBR
                {0x1b0, 2032},                                           // FTRL
                {0x144, 0x100},                                          // TFWR
                {0x1c0, 0},                                              // TACC
                {0x1c4, 0},                                              // RACC
                {0x180, receive},                                        // RDSR
                {0x184, transmit},                                       // TDSR
                {0x044, 0},                                              // MSCR, off
                {0x044, 26},                                             // 2.36 MHz
                {0x084, 0x05ee'0044},                                    // RCR
                {0x0c4, 4},                                              // TCR, full duplex
                {0x024, 0x120},                                          // DBSWP, SPEED
                {0x024, 0x122},                                          // ETHEREN
                {0x010, 0x0100'0000},                                    // RDAR
                {0x008, 0x0200'0000},                                    // EIMR
            }));
  EXPECT_EQ(restarts(), 1u);
}

// All speeds and both duplexes, one after the other. RCR, TCR and the speed in ECR change only
// while ETHEREN is clear.
TEST_F(Restart, NothingOfTheModeChangesWhileTheControllerRuns) {
  struct Mode {
    std::uint16_t partner;
    std::uint16_t gigabit;
    std::uint32_t rcr, tcr, ecr;
  };
  constexpr Mode kModes[] = {{kHalf100, 0, 0x05ee'0046, 0, 0x102},
                             {kFull10, 0, 0x05ee'0244, 4, 0x102},
                             {kFull100, kGigabitFull, 0x05ee'0044, 4, 0x122},
                             {0x0021, 0, 0x05ee'0246, 0, 0x102},
                             {kFull100, 0, 0x05ee'0044, 4, 0x102}};
  std::uint32_t now_us = 0;
  std::uint32_t expected = 0;
  forget();
  for (const Mode& mode : kModes) {
    link_down(now_us += 1'000'000);
    link_up(now_us += 1'000'000, mode.partner, mode.gigabit);
    EXPECT_EQ(peek<std::uint32_t>(registers_.rcr), mode.rcr);
    EXPECT_EQ(peek<std::uint32_t>(registers_.tcr), mode.tcr);
    EXPECT_EQ(peek<std::uint32_t>(registers_.ecr), mode.ecr);
    EXPECT_EQ(restarts(), ++expected);
  }
  bool runs = true;
  std::uint32_t speed = 0;
  for (const Write& write : machine::writes_to(registers_)) {
    if (write.offset == 0x024) {
      const bool changes_speed = ((write.value ^ speed) & 0x20) != 0;
      EXPECT_FALSE(runs && (write.value & 2) != 0 && changes_speed) << write;
      runs = (write.value & 2) != 0;
      speed = write.value;
    }
    const std::set<std::size_t> of_data{0x004, 0x008, 0x010, 0x014, 0x040};
    EXPECT_FALSE(runs && write.offset != 0x024 && !of_data.contains(write.offset)) << write;
  }
}

TEST_F(Restart, ALinkThatComesBackAsItWasRestartsNothing) {
  link_up(0, kFull100, kGigabitFull);
  link_down(1'000'000);
  EXPECT_EQ(peek<std::uint32_t>(registers_.ecr), 0x122u) << "still for 1000 Mbit/s";
  link_up(2'000'000, kFull100, kGigabitFull);
  EXPECT_EQ(restarts(), 1u);
}

TEST_F(Restart, ABusErrorStartsThePortAnew) {
  link_up(0, kFull100);
  EXPECT_EQ(restarts(), 0u);
  queue(3);
  pump_at(1'000'000);
  queue(2);
  arrive(64);
  raise(kBusError);
  poke(registers_.ecr, 0x100u);  // by the manual it has stopped itself
  pump_at(1'000'001);
  const hal::PortCounters counters = port_.counters();
  EXPECT_EQ(counters.restarts, 1u);
  EXPECT_EQ(counters.lost_unsent, 5u);
  EXPECT_EQ(counters.lost_received, 1u);
  EXPECT_EQ(peek<std::uint32_t>(registers_.ecr), 0x102u);
  EXPECT_EQ(events() & kBusError, 0u);
  for (const Descriptor& descriptor : receive_) {
    EXPECT_NE(descriptor.flags & receive_flag::kEmpty, 0);
  }
  arrive(100);
  EXPECT_EQ(port_.receive().size(), 96u) << "frames come again";
  queue(1);
  pump_at(1'100'000);
  EXPECT_EQ(send_all(), 1u) << "and leave";
}

// What cannot be healed costs at most ten starts a second, not every pass of the loop.
TEST_F(Restart, ABusThatStaysBadIsTriedTenTimesASecond) {
  for (std::uint32_t ms = 0; ms < 1000; ++ms) {
    raise(kBusError);
    pump_at(1'000'000 + 1000 * ms);
  }
  EXPECT_EQ(restarts(), 10u);
}

TEST_F(Restart, AFrameThatNeverLeavesStartsThePortAnewAfterHalfASecond) {
  link_up(0, kFull100);
  queue(kTransmit);
  pump_at(1'000'000);
  EXPECT_TRUE(port_.acquire().empty()) << "the ring is full";
  pump_at(1'499'999);
  EXPECT_EQ(restarts(), 0u);
  pump_at(1'500'000);
  EXPECT_EQ(restarts(), 1u);
  EXPECT_EQ(port_.counters().lost_unsent, kTransmit);
  EXPECT_FALSE(port_.acquire().empty());
  port_.commit(60);
  pump_at(1'510'000);
  EXPECT_EQ(send_all(), 1u);
}

// 366 ms of backing off at 10 Mbit/s and half duplex are slow, not stuck.
TEST_F(Restart, FramesThatLeaveSlowlyAreNoReason) {
  link_up(0, kFull100);
  queue(20);
  std::uint32_t now_us = 1'000'000;
  pump_at(now_us);
  for (int frame = 0; frame < 20; ++frame) {
    pump_at(now_us += 200'000);
    EXPECT_EQ(send(1), 1u);
    pump_at(now_us += 200'000);
  }
  EXPECT_EQ(restarts(), 0u);
  pump_at(now_us += 10'000'000);
  EXPECT_EQ(restarts(), 0u) << "nothing waits any more";
}

// The transmit clock is the PHY's. Frames that wait for a cable have their time when it comes.
TEST_F(Restart, WithoutALinkNothingIsStuck) {
  queue(1);
  pump_at(0);
  for (std::uint32_t now_us = 0; now_us < 10'000'000; now_us += 100'000) {
    pump_at(now_us);
  }
  EXPECT_EQ(restarts(), 0u);
  link_up(10'000'000, kFull100);
  EXPECT_EQ(restarts(), 0u);
  pump_at(10'800'000);
  EXPECT_EQ(restarts(), 1u);
}

// docs/safety.md: a port that is silent has a reason, or is not alive.
TEST_F(Restart, SilenceIsExcusedByNoLinkOrByNothingToDo) {
  queue(1);
  pump_at(0);
  EXPECT_TRUE(port_.life().is_excused) << "there is no link";
  link_up(1'000'000, kFull100);
  pump_at(1'100'000);
  queue(1);
  EXPECT_FALSE(port_.life().is_excused) << "a frame waits";
  pump_at(1'101'000);
  EXPECT_FALSE(port_.life().is_excused) << "it is on its way";
  const std::uint32_t moved = port_.life().moved;
  EXPECT_EQ(send(1), 1u);
  pump_at(1'200'000);
  EXPECT_EQ(port_.life().moved, moved + 1) << "it has left";
  EXPECT_TRUE(port_.life().is_excused);
}

// IMX6DQRM, ENET_RDAR and ENET_ECR: neither reads as set once the controller has stopped.
TEST_F(Restart, AReceiverThatHasStoppedIsNoExcuse) {
  link_up(0, kFull100);
  pump_at(100'000);
  ASSERT_TRUE(port_.life().is_excused);
  machine::poke(registers_.rdar, 0u);
  EXPECT_FALSE(port_.life().is_excused);
  machine::poke(registers_.rdar, EnetRegisters::kRdarActive);
  const auto control = machine::peek<std::uint32_t>(registers_.ecr);
  machine::poke(registers_.ecr, control & ~EnetRegisters::kEcrEtherEn);
  EXPECT_FALSE(port_.life().is_excused);
}

TEST_F(Restart, WaitsForABufferThatIsBeingFilled) {
  const std::span<std::byte> buffer = port_.acquire();
  raise(kBusError);
  pump_at(1'000'000);
  EXPECT_EQ(restarts(), 0u);
  EXPECT_EQ(port_.acquire().data(), buffer.data());
  port_.commit(60);
  pump_at(1'000'001);
  EXPECT_EQ(restarts(), 1u);
  EXPECT_EQ(port_.counters().lost_unsent, 1u);
}

TEST_F(Restart, AFrameThatIsShownStaysUntilItIsReleased) {
  arrive(64);
  const std::span<const std::byte> frame = port_.receive();
  const std::vector<std::byte> before(frame.begin(), frame.end());
  raise(kBusError);
  pump_at(1'000'000);
  EXPECT_EQ(restarts(), 1u);
  std::ranges::fill(receive_bytes_, std::byte{0xee});
  EXPECT_EQ(port_.receive().data(), frame.data());
  EXPECT_TRUE(std::ranges::equal(frame, before));
  EXPECT_EQ(port_.counters().lost_received, 0u);
  port_.release();
}

// The second half of a frame of several buffers went with the first.
TEST_F(Restart, AFrameAfterHalfAFrameIsWhole) {
  arrive(2032, 0);
  EXPECT_TRUE(port_.receive().empty());
  raise(kBusError);
  pump_at(1'000'000);
  arrive(64);
  EXPECT_EQ(port_.receive().size(), 60u);
}

// Whether a reset clears the controller's statistics or not: nothing is counted twice or lost.
TEST_F(Restart, FramesWithoutRoomStayCounted) {
  poke(registers_.ieee_r_macerr, 7u);
  forget();
  machine::recorder.on_store = [this, ram = machine::recorder.on_store](const void* address,
                                                                        std::uint32_t value) {
    ram(address, value);
    if (address == &registers_.mibc && (value & EnetRegisters::kMibcClear) != 0) {
      poke(registers_.ieee_r_macerr, 0u);
    }
  };
  raise(kBusError);
  pump_at(1'000'000);
  EXPECT_EQ(port_.counters().receive_overflows, 7u);
  poke(registers_.ieee_r_macerr, 2u);
  pump_at(1'001'000);
  EXPECT_EQ(port_.counters().receive_overflows, 9u);
}

// An access to the PHY that a reset cut off says nothing of the link.
TEST_F(Restart, TheLinkStaysUp) {
  link_up(0, kFull100, kGigabitFull);
  machine::recorder.on_store = [this, ram = machine::recorder.on_store](const void* address,
                                                                        std::uint32_t value) {
    if (address != &registers_.mmfr) {
      ram(address, value);  // the bus takes longer
    }
  };
  pump_at(1'000'000);
  raise(kBusError);
  pump_at(1'000'010);
  EXPECT_EQ(restarts(), 2u);
  pump_at(1'003'100);
  EXPECT_TRUE(port_.link().up);
  EXPECT_EQ(peek<std::uint32_t>(registers_.ecr), 0x122u) << "for 1000 Mbit/s again";
}

}  // namespace
}  // namespace iog::imx6
