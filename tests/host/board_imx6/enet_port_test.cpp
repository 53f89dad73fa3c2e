// The Ethernet port against a controller made of RAM: hal/ethernet_port.hpp, the drops, the start.
#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "port_on_ram.hpp"

namespace iog::imx6 {
namespace {

using machine::last_write;
using machine::peek;
using machine::poke;
using machine::Write;

using Port = PortOnRam;

TEST_F(Port, StartsByTheManualWithEtherenNearTheEnd) {
  const std::vector<Write> writes = machine::writes_to(registers_);
  const std::vector<Write> begin(writes.begin(), writes.begin() + 3);
  EXPECT_EQ(begin, (std::vector<Write>{{0x008, 0}, {0x024, 0}, {0x024, 1}}))
      << "EIMR; a loader's ETHEREN; reset";
  EXPECT_EQ(last_write(registers_, 0x0e4), 0x0211'2233u);
  EXPECT_EQ(last_write(registers_, 0x0e8), 0x4455'8808u);
  EXPECT_EQ(last_write(registers_, 0x084),
            0x05ee'0044u);                           // MAX_FL 1518, RGMII, MII; promiscuous off
  EXPECT_EQ(last_write(registers_, 0x0c4), 0x4u);    // full duplex
  EXPECT_EQ(last_write(registers_, 0x144), 0x100u);  // store and forward
  EXPECT_EQ(last_write(registers_, 0x188), 2032u);
  EXPECT_EQ(last_write(registers_, 0x1b0), 2032u);
  EXPECT_EQ(last_write(registers_, 0x180), machine::bus_address(receive_[0]));
  EXPECT_EQ(last_write(registers_, 0x184), machine::bus_address(transmit_[0]));
  std::vector<Write> statistics;
  std::ranges::copy_if(writes, std::back_inserter(statistics),
                       [](const Write& write) { return write.offset == 0x064; });
  EXPECT_EQ(statistics,
            (std::vector<Write>{{0x064, 0xa000'0000}, {0x064, 0x8000'0000}, {0x064, 0}}))
      << "cleared, then counting";
  const std::vector<Write> end(writes.end() - 3, writes.end());
  const std::vector<Write> expected = {
      {0x024, 0x102},        // ECR: DBSWP, ETHEREN
      {0x010, 0x0100'0000},  // RDAR
      {0x008, 0x0200'0000},  // EIMR: a received frame wakes
  };
  EXPECT_EQ(end, expected);
}

// The group of service discovery, 224.244.224.245, and another: the six highest bits of the CRC-32
// of their addresses, by Python's zlib and inverted back, as Linux's fec_main.c has it.
TEST_F(Port, LetsAGroupThroughItsFilterAlsoAfterARestart) {
  EXPECT_EQ(last_write(registers_, 0x120), 0u);
  EXPECT_EQ(last_write(registers_, 0x124), 0u);
  port_.join({0x01, 0x00, 0x5e, 0x74, 0xe0, 0xf5});  // 27
  EXPECT_EQ(last_write(registers_, 0x120), 0u);
  EXPECT_EQ(last_write(registers_, 0x124), 1u << 27);
  port_.join({0x01, 0x00, 0x5e, 0x00, 0x00, 0xfb});  // 33
  EXPECT_EQ(last_write(registers_, 0x120), 1u << 1);
  EXPECT_EQ(last_write(registers_, 0x124), 1u << 27);
  forget();
  link_up(1'000'000, 0x0101, 0x0800);  // another speed
  EXPECT_EQ(port_.counters().restarts, 1u);
  EXPECT_EQ(last_write(registers_, 0x120), 1u << 1);
  EXPECT_EQ(last_write(registers_, 0x124), 1u << 27);
}

TEST_F(Port, SaysHowManyBuffersAreFree) {
  EXPECT_EQ(port_.room(), kTransmit);
  queue(5);
  EXPECT_EQ(port_.room(), kTransmit - 5);
  pump_at(1'000);
  EXPECT_EQ(port_.room(), kTransmit - 5) << "in flight";
  send(3);
  EXPECT_EQ(port_.room(), kTransmit - 2);
}

TEST_F(Port, ShowsTheOldestFrameUntilItIsReleased) {
  EXPECT_TRUE(port_.receive().empty());
  arrive(64);
  arrive(100);
  EXPECT_EQ(port_.receive().size(), 60u) << "without FCS";
  EXPECT_EQ(port_.receive().size(), 60u);
  EXPECT_EQ(port_.receive()[0], std::byte{0});
  port_.release();
  EXPECT_EQ(port_.receive().size(), 96u);
  EXPECT_EQ(port_.receive()[0], std::byte{1});
  port_.release();
  EXPECT_TRUE(port_.receive().empty());
  EXPECT_EQ(port_.counters().received, 2u);
}

// Of every length: what is shown is the whole frame, and not the controller's any more.
TEST_F(Port, AFrameIsCopiedOnceAndItsBufferGivenBackAtOnce) {
  for (std::size_t bytes = 14; bytes <= 1514; ++bytes) {
    const std::size_t at = arrived_ % kReceive;
    const std::span<std::byte> buffer =
        std::span(receive_bytes_).subspan(at * DescriptorFormat::kReceiveBytes, bytes);
    std::ranges::generate(buffer, [value = bytes]() mutable { return std::byte(value++ * 37); });
    const std::vector<std::byte> sent(buffer.begin() + 1, buffer.end());
    arrive(bytes + 4);
    poke(registers_.rdar, 0u);
    const std::span<const std::byte> frame = port_.receive();
    EXPECT_NE(receive_[at].flags & receive_flag::kEmpty, 0);
    EXPECT_EQ(peek<std::uint32_t>(registers_.rdar), 0x0100'0000u) << "it looks for buffers again";
    std::ranges::fill(buffer, std::byte{0xee});  // the controller fills it anew
    ASSERT_EQ(frame.size(), bytes);
    ASSERT_TRUE(std::ranges::equal(frame.subspan(1), sent)) << bytes;
    port_.release();
  }
}

// The controller stops looking when no buffer is empty. Whoever frees one has to wake it, whatever
// was in it, or a ring full of bad frames would be its last.
TEST_F(Port, ARingFullOfBadFramesIsGivenBackToo) {
  for (std::size_t count = 0; count < kReceive; ++count) {
    arrive(64, receive_flag::kLast | receive_flag::kBadCrc);
  }
  poke(registers_.rdar, 0u);
  EXPECT_TRUE(port_.receive().empty());
  EXPECT_EQ(port_.counters().receive_errors, kReceive);
  EXPECT_EQ(peek<std::uint32_t>(registers_.rdar), 0x0100'0000u);
}

// Bad frames come as fast as they are dropped: the loop has its turn after one ring of them.
TEST_F(Port, AFloodOfBadFramesHoldsNobody) {
  const auto arrive_bad = [this] { arrive(64, receive_flag::kLast | receive_flag::kBadCrc); };
  arrive_bad();
  machine::recorder.on_store = [&](const void* address, std::uint32_t /*value*/) {
    if (address == &registers_.rdar) {
      arrive_bad();
    }
  };
  EXPECT_TRUE(port_.receive().empty());
  EXPECT_EQ(port_.counters().receive_errors, EnetMemory::kReceiveFrames);
  EXPECT_TRUE(port_.receive().empty());
  EXPECT_EQ(port_.counters().receive_errors, 2 * EnetMemory::kReceiveFrames);
}

TEST_F(Port, TheRingTurnsForEver) {
  for (int count = 0; count < 1000; ++count) {
    arrive(64);
    ASSERT_EQ(port_.receive().size(), 60u);
    ASSERT_EQ(port_.receive()[0], std::byte{static_cast<std::uint8_t>(count)});
    port_.release();
  }
}

TEST_F(Port, FramesMarkedBadAreCountedAndDropped) {
  constexpr std::uint16_t kLast = receive_flag::kLast;
  for (const std::uint16_t bad :
       {receive_flag::kBadCrc, receive_flag::kNonOctet, receive_flag::kOverrun}) {
    arrive(64, static_cast<std::uint16_t>(kLast | bad));
    EXPECT_TRUE(port_.receive().empty());
  }
  arrive(17);  // shorter than header and FCS
  EXPECT_TRUE(port_.receive().empty());
  arrive(1519);  // not marked, and yet too long
  EXPECT_TRUE(port_.receive().empty());
  arrive(64);
  EXPECT_EQ(port_.receive().size(), 60u);
  EXPECT_EQ(port_.counters().receive_errors, 5u);
  EXPECT_EQ(port_.counters().received, 1u);
}

TEST_F(Port, FramesThatTheControllerHadNoRoomForAreItsOwnCount) {
  EXPECT_EQ(port_.counters().receive_overflows, 0u);
  poke(registers_.ieee_r_macerr, 7u);
  pump_at(1'000);
  EXPECT_EQ(port_.counters().receive_overflows, 7u);
  poke(registers_.ieee_r_macerr, 8u);
  pump_at(2'000);
  EXPECT_EQ(port_.counters().receive_overflows, 8u);
}

TEST_F(Port, AFrameInSeveralBuffersCountsOnce) {
  arrive(2032, 0);
  arrive(4064, 0);
  arrive(4100, receive_flag::kLast | receive_flag::kTooLong);
  arrive(64);
  EXPECT_EQ(port_.receive().size(), 60u);
  EXPECT_EQ(port_.counters().oversized, 1u);
  port_.release();
  arrive(1600, receive_flag::kLast | receive_flag::kTooLong);
  EXPECT_TRUE(port_.receive().empty());
  EXPECT_EQ(port_.counters().oversized, 2u);
  EXPECT_EQ(port_.counters().receive_errors, 0u);
}

TEST_F(Port, AcquireGivesTheSameBufferUntilCommit) {
  const std::span<std::byte> first = port_.acquire();
  EXPECT_GE(first.size(), 1514u);
  EXPECT_EQ(port_.acquire().data(), first.data());
  port_.commit(14);
  EXPECT_NE(port_.acquire().data(), first.data());
}

TEST_F(Port, OnlyPumpHandsOverAndAtMostABurst) {
  queue(kTransmit);
  EXPECT_EQ(send_all(), 0u) << "committed is not sent";
  pump_at(0);
  EXPECT_EQ(send_all(), board::TransmitShaper::kBurstFrames);
  pump_at(100);
  EXPECT_EQ(send_all(), 0u);
  pump_at(260);
  EXPECT_EQ(send_all(), kTransmit - board::TransmitShaper::kBurstFrames);
  EXPECT_EQ(port_.counters().sent, kTransmit);
}

TEST_F(Port, AFullRingIsRefusedAndCountedUntilFramesAreSent) {
  queue(kTransmit);
  EXPECT_TRUE(port_.acquire().empty());
  EXPECT_TRUE(port_.acquire().empty());
  EXPECT_EQ(port_.counters().send_refused, 2u);
  pump_at(0);
  EXPECT_TRUE(port_.acquire().empty()) << "in flight is not free";
  send_all();
  EXPECT_FALSE(port_.acquire().empty());
  EXPECT_EQ(port_.counters().send_refused, 3u);
}

// Erratum ERR006358: TDAR may lose the write, so it is written again while frames are on the way.
TEST_F(Port, AWakeUpThatWasLostIsRepeated) {
  queue(1);
  pump_at(0);
  EXPECT_EQ(peek<std::uint32_t>(registers_.tdar), 0x0100'0000u);
  poke(registers_.tdar, 0u);  // lost, the frame still ready
  pump_at(1);
  EXPECT_EQ(peek<std::uint32_t>(registers_.tdar), 0x0100'0000u);
  send_all();
  pump_at(2);
  EXPECT_EQ(peek<std::uint32_t>(registers_.tdar), 0u) << "nothing is on the way any more";
}

TEST_F(Port, ClearingTheEventTouchesNoOtherFlag) {
  forget();
  port_.clear_event();
  EXPECT_EQ(machine::writes_to(registers_), (std::vector<Write>{{0x004, 0x0200'0000}}));
}

using PortDeathTest = Port;

TEST_F(PortDeathTest, BrokenRulesStop) {
  EXPECT_DEATH(port_.release(), "");
  EXPECT_DEATH(port_.commit(60), "");
  port_.acquire();
  EXPECT_DEATH(port_.commit(13), "");
  EXPECT_DEATH(port_.commit(1515), "");
}

}  // namespace
}  // namespace iog::imx6
