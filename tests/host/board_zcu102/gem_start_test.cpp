// How the GEM starts and restarts. board_imx6/enet_restart_test.cpp tests when the port restarts
// it. Offsets, bits and order: UG1087 modules "GEM" and "CRL_APB", UG1085 chapter "GEM Ethernet",
// section "Programming model".
#include <gtest/gtest.h>
#include <vector>

#include "gem_on_ram.hpp"

namespace iog::zcu102 {
namespace {

using machine::last_write;
using machine::peek;
using machine::Write;

constexpr std::uint16_t kFull100 = 0x0100 | 1;
constexpr std::uint16_t kHalf10 = 0x0020 | 1;
constexpr std::uint16_t kGigabitFull = 0x0800;

class Start : public GemOnRam {
 protected:
  [[nodiscard]] std::uint32_t restarts() const { return port_.counters().restarts; }
};

TEST_F(Start, WritesEachRegisterAndReceivesLastOfAll) {
  std::vector<Write> writes = machine::writes_to(registers_);
  std::erase_if(writes, [](const Write& write) { return write.offset == 0x034; });  // MDIO
  EXPECT_EQ(writes, (std::vector<Write>{
                        {0x02c, 0xffff'ffff},  // IDR
                        {0x000, 0},            // stops
                        {0x000, 0x20},         // clears statistics
                        {0x014, 0xffff'ffff},  // TSR
                        {0x020, 0xffff'ffff},  // RSR
                        {0x024, 0},            // ISR
                        {0x004, 0x003e'0043},  // 64 bits, /224, FCS,
                                               // hash, full, 100
                        {0x010, 0x4018'0710},  // 64 bits, 1536 bytes
                        {0x4d4, 0},            // upper halves
                        {0x4c8, 0},
                        {0x018, machine::bus_address(receive_[0])},
                        {0x01c, machine::bus_address(transmit_[0])},
                        {0x480, machine::bus_address(parked_queues[0])},
                        {0x440, machine::bus_address(parked_queues[1])},
                        {0x088, 0x3322'1102},
                        {0x08c, 0x0000'5544},
                        {0x080, 0},
                        {0x084, 0},
                        {0x000, 0x10},  // MDIO
                        {0x028, 2},     // a frame wakes
                        {0x000, 0x1c},  // receives, sends
                    }));
}

TEST_F(Start, UnusedQueuesAreParked) {
  EXPECT_EQ(parked_queues[0].address, 3u) << "ours, wraps";
  EXPECT_EQ(parked_queues[1].control, 0xc000'0000u) << "ours, wraps";
}

TEST_F(Start, RingsHaveDescriptorsOfFourWords) {
  for (std::size_t index = 0; index < kReceive; ++index) {
    const auto address =
        machine::bus_address(receive_bytes_[index * DescriptorFormat::kReceiveBytes]);
    EXPECT_EQ(receive_[index].address, address | (index == kReceive - 1 ? 2u : 0u));
    EXPECT_EQ(receive_[index].address_high, 0u);
  }
  EXPECT_EQ(transmit_[0].control, 0x8000'0000u);
  EXPECT_EQ(transmit_[kTransmit - 1].control, 0xc000'0000u);
}

// UG1085, "Hash addressing": bit i of the bin is the sum of the bits i, i + 6, ... i + 42 of the
// address, by a program of its own in Python.
TEST_F(Start, LetsAGroupThroughItsFilterAlsoAfterARestart) {
  port_.join({0x01, 0x00, 0x5e, 0x74, 0xe0, 0xf5});  // 32
  EXPECT_EQ(last_write(registers_, 0x080), 0u);
  EXPECT_EQ(last_write(registers_, 0x084), 1u);
  port_.join({0x01, 0x00, 0x5e, 0x00, 0x00, 0x02});  // 22
  EXPECT_EQ(last_write(registers_, 0x080), 1u << 22);
  forget();
  link_up(1'000'000, kFull100, kGigabitFull);
  EXPECT_EQ(last_write(registers_, 0x080), 1u << 22);
  EXPECT_EQ(last_write(registers_, 0x084), 1u);
}

// 125, 25 and 2.5 MHz of 1500 MHz; nothing of the mode changes while the controller runs.
TEST_F(Start, AnotherSpeedIsSetWhileTheControllerIsStopped) {
  struct Mode {
    std::uint16_t partner;
    std::uint16_t gigabit;
    std::uint32_t config, clock;
  };
  constexpr Mode kModes[] = {{kFull100, kGigabitFull, 0x003e'0442, 0x0601'0c00},
                             {kHalf10, 0, 0x003e'0040, 0x0632'0c00},
                             {kFull100, 0, 0x003e'0043, 0x0605'0c00}};
  std::uint64_t at_us = 0;
  std::uint32_t expected = 0;
  forget();
  for (const Mode& mode : kModes) {
    link_down(at_us += 1'000'000);
    link_up(at_us += 1'000'000, mode.partner, mode.gigabit);
    EXPECT_EQ(peek<std::uint32_t>(registers_.network_config), mode.config);
    EXPECT_EQ(peek<std::uint32_t>(clocks_.gem3_ref_ctrl), mode.clock);
    EXPECT_EQ(restarts(), ++expected);
  }
  bool runs = true;
  for (const Write& write : machine::writes_to(registers_)) {
    if (write.offset == 0x000) {
      runs = (write.value & 0xc) != 0;
    }
    EXPECT_FALSE(runs && (write.offset == 0x004 || write.offset == 0x018)) << write;
  }
}

TEST_F(Start, ABusErrorStartsThePortAnewAndCountsWhatIsLost) {
  link_up(0, kFull100, 0);
  ASSERT_EQ(restarts(), 0u);
  for (auto* status : {&registers_.transmit_status, &registers_.receive_status}) {
    const hal::PortCounters before = port_.counters();
    queue(3);
    pump_at(machine::counter_us + 1'000'000);
    queue(2);
    arrive(60);
    raise(*status, status == &registers_.receive_status ? 8 : 0x100);
    pump_at(machine::counter_us + 1);
    const hal::PortCounters counters = port_.counters();
    EXPECT_EQ(counters.restarts, before.restarts + 1);
    EXPECT_EQ(counters.lost_unsent, before.lost_unsent + 5);
    EXPECT_EQ(counters.lost_received, before.lost_received + 1);
    EXPECT_EQ(peek<std::uint32_t>(*status), 0u);
    arrived_ = sent_ = 0;
    arrive(60);
    EXPECT_EQ(port_.receive().size(), 60u) << "frames come again";
    port_.release();
    arrived_ = 1;
  }
}

}  // namespace
}  // namespace iog::zcu102
