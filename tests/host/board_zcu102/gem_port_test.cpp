// The GEM's port against a controller made of RAM: its descriptors, the drops, a full ring. What
// the ports of both boards share is asked in board_imx6/enet_port_test.cpp. Offsets and bits of
// registers and descriptors: UG1087 module "GEM", UG1085 "GEM Ethernet".
#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "gem_on_ram.hpp"

namespace iog::zcu102 {
namespace {

using machine::poke;
using machine::Write;

using Port = GemOnRam;

TEST_F(Port, ShowsTheOldestFrameAndGivesItsBufferBackAtOnce) {
  EXPECT_TRUE(port_.receive().empty());
  arrive(60);
  arrive(1514);
  EXPECT_EQ(port_.receive().size(), 60u);
  EXPECT_EQ(receive_[0].address & 1, 0u) << "the controller's again";
  EXPECT_EQ(receive_[1].address & 1, 1u);
  std::ranges::fill(receive_bytes_, std::byte{0xee});
  EXPECT_EQ(port_.receive()[0], std::byte{0}) << "a copy";
  port_.release();
  EXPECT_EQ(port_.receive().size(), 1514u);
  port_.release();
  EXPECT_TRUE(port_.receive().empty());
  EXPECT_EQ(port_.counters().received, 2u);
}

TEST_F(Port, TheReceiveRingTurnsAndWrapsAtItsEnd) {
  for (std::size_t count = 0; count < 100; ++count) {
    arrive(60);
    ASSERT_EQ(port_.receive()[0], std::byte{static_cast<std::uint8_t>(count)});
    port_.release();
    for (std::size_t index = 0; index < kReceive; ++index) {
      ASSERT_EQ(receive_[index].address & 2, index == kReceive - 1 ? 2u : 0u);
    }
  }
}

TEST_F(Port, FramesOutsideTheBoundsAreCountedAndDropped) {
  arrive(13);
  arrive(1515);
  EXPECT_TRUE(port_.receive().empty());
  EXPECT_EQ(port_.counters().receive_errors, 2u);
  arrive(0, receive_flag::kFirst);
  arrive(0, 0);
  arrive(1536, receive_flag::kLast);
  EXPECT_TRUE(port_.receive().empty());
  EXPECT_EQ(port_.counters().oversized, 1u) << "one frame of three buffers";
  arrive(60);
  EXPECT_EQ(port_.receive().size(), 60u);
}

// QEMU 7.2 keeps the descriptor that it found used until NETWORK_CONTROL is written with the
// receiver on, and drops what waits beyond the free buffers then.
TEST_F(Port, AFullRingIsLookedAtAgainWhenItIsEmpty) {
  fill_the_ring();
  raise(registers_.receive_status, 0b111);
  forget();
  take(kReceive);
  EXPECT_TRUE(machine::writes_to(registers_).empty()) << "not while frames wait";
  EXPECT_TRUE(port_.receive().empty());
  EXPECT_EQ(machine::writes_to(registers_), (std::vector<Write>{{0x020, 1}, {0x000, 0x1c}}));
  EXPECT_EQ(machine::peek<std::uint32_t>(registers_.receive_status), 0b110u);
  EXPECT_EQ(port_.counters().receive_overflows, 1u) << "at least one was lost";
  EXPECT_TRUE(port_.receive().empty());
  EXPECT_EQ(port_.counters().receive_overflows, 1u);
}

// QEMU 7.2 looks at the first descriptor of each queue at each write of NETWORK_CONTROL, such as
// the start of the transmitter. That of the parked queue is never free, so the flag is set.
TEST_F(Port, ARingThatWasNotFullHasLostNothing) {
  arrive(60);
  take(1);
  raise(registers_.receive_status, 0b111);
  forget();
  EXPECT_TRUE(port_.receive().empty());
  EXPECT_EQ(machine::writes_to(registers_), (std::vector<Write>{{0x020, 1}}));
  EXPECT_EQ(port_.counters().receive_overflows, 0u);
}

TEST_F(Port, StatisticsOfTheControllerAreCountedOnce) {
  machine::recorder.on_load = [this](const void* address) {
    const auto* at = static_cast<const std::byte*>(address);
    const auto offset = at - reinterpret_cast<const std::byte*>(&registers_);
    poke(registers_.excessive_rx_length, offset == 0x188 ? counted_ : 0u);
    poke(registers_.fcs_errors, offset == 0x190 ? counted_ : 0u);
    poke(registers_.rx_resource_errors, offset == 0x1a0 ? counted_ : 0u);
    poke(registers_.rx_overruns, offset == 0x1a4 ? counted_ : 0u);
    counted_ = offset == 0x1a4 ? 0 : counted_;  // reading clears them
  };
  counted_ = 7;
  pump_at(1000);
  pump_at(2000);
  EXPECT_EQ(port_.counters().oversized, 7u);
  EXPECT_EQ(port_.counters().receive_errors, 7u);
  EXPECT_EQ(port_.counters().receive_overflows, 14u) << "without a buffer; overrun";
  fill_the_ring();
  take(kReceive);
  counted_ = 3;
  raise(registers_.receive_status, 1);
  EXPECT_TRUE(port_.receive().empty());
  EXPECT_EQ(port_.counters().receive_overflows, 20u) << "the statistic has the lost frames";
}

TEST_F(Port, OnlyPumpHandsOverAndAtMostABurst) {
  queue(kTransmit);
  EXPECT_TRUE(port_.acquire().empty());
  EXPECT_EQ(port_.counters().send_refused, 1u);
  EXPECT_EQ(send(), 0u) << "committed is not sent";
  forget();
  pump_at(0);
  EXPECT_EQ(machine::last_write(registers_, 0x000), 0x21cu) << "started";
  EXPECT_EQ(transmit_[0].control, 0x8000u | 60);
  EXPECT_EQ(send(), TransmitShaper::kBurstFrames);
  EXPECT_EQ(port_.room(), TransmitShaper::kBurstFrames);
  pump_at(260);
  EXPECT_EQ(transmit_[kTransmit - 1].control, 0x4000'8000u | 60) << "wraps";
  EXPECT_EQ(send(), kTransmit - TransmitShaper::kBurstFrames);
  EXPECT_EQ(port_.counters().sent, kTransmit);
}

// What the controller reads of a descriptor is in memory before the bit that makes it its own.
TEST_F(Port, TheOwnerBitComesLastBehindABarrier) {
  queue(1);
  forget();
  pump_at(0);
  using Kind = machine::Event::Kind;
  std::vector<Kind> kinds;
  for (const machine::Event& event : machine::recorder.events) {
    if (event.address == nullptr || event.address == &transmit_[0].control ||
        event.address == &registers_.network_control) {
      kinds.push_back(event.kind);
    }
  }
  EXPECT_EQ(kinds, (std::vector<Kind>{Kind::kBarrier, Kind::kStore, Kind::kBarrier, Kind::kStore}));
}

TEST_F(Port, AStartThatWasLostIsRepeatedWhileFramesAreInFlight) {
  queue(1);
  pump_at(0);
  forget();
  pump_at(1);
  EXPECT_EQ(machine::writes_to(registers_), (std::vector<Write>{{0x000, 0x21c}}));
  send();
  forget();
  pump_at(2);
  EXPECT_TRUE(machine::writes_to(registers_).empty());
}

TEST_F(Port, TheEventIsClearedByReadingAndByWriting) {
  poke(registers_.int_status, 0x2u);
  forget();
  port_.clear_event();
  EXPECT_EQ(machine::writes_to(registers_), (std::vector<Write>{{0x024, 2}}));
}

// docs/safety.md: a port that is silent has a reason, or is not alive.
TEST_F(Port, SilenceIsExcusedByNoLinkOrByNothingToDo) {
  queue(1);
  EXPECT_TRUE(port_.life().is_excused) << "there is no link";
  link_up(1'000'000, 0x01e1, 0x0800);
  queue(1);
  EXPECT_FALSE(port_.life().is_excused) << "a frame waits";
  sent_ = 0;  // the link's speed was new, and the rings began again
  pump_at(1'300'000);
  EXPECT_EQ(send(), 1u);
  pump_at(1'310'000);
  EXPECT_TRUE(port_.life().is_excused);
  poke(registers_.network_control, 0x18u);
  EXPECT_FALSE(port_.life().is_excused) << "the receiver is off";
}

}  // namespace
}  // namespace iog::zcu102
