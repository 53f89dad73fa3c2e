// Descriptor rings: ownership, order of the stores, wrap-around.
#include "board/common/ethernet/rings.hpp"

#include <array>
#include <gtest/gtest.h>
#include <vector>

#include "ethernet/descriptor.hpp"
#include "trace.hpp"

namespace iog::imx6 {
namespace {

using machine::Event;
using machine::recorder;
using Receiving = board::ReceiveRing<DescriptorFormat>;
using Sending = board::TransmitRing<DescriptorFormat>;

constexpr std::size_t kFrames = 4;

// True if a barrier lies between the last store to any other address of memory and each store of an
// owner bit: what was written before is in memory before the controller may look.
bool owner_bit_comes_last(std::uint16_t owner, const std::array<Descriptor, kFrames>& ring) {
  bool drained = false;
  for (const Event& event : recorder.events) {
    if (event.kind == Event::Kind::kBarrier) {
      drained = true;
      continue;
    }
    bool hands_over = false;
    for (const Descriptor& descriptor : ring) {
      hands_over |= event.address == &descriptor.flags && (event.value & owner) != 0;
    }
    if (hands_over && !drained) {
      return false;
    }
    drained &= hands_over;  // further owner bits may follow, nothing else
  }
  return true;
}

class Rings : public testing::Test {
 protected:
  Rings() { recorder.reset(); }

  Pl310Registers pl310_{};
  L2Cache cache_{pl310_};
  std::array<Descriptor, kFrames> descriptors_{};
  std::vector<std::byte> receive_buffers_{kFrames * Receiving::kBufferBytes};
  std::vector<std::byte> transmit_buffers_{kFrames * Sending::kBufferBytes};
};

class Receive : public Rings {
 protected:
  Receive() {
    ring_.start();
    recorder.reset();
  }

  void fill(std::size_t index, std::uint16_t length) {
    Descriptor& descriptor = descriptors_[index];
    descriptor.length = length;
    descriptor.flags =
        static_cast<std::uint16_t>((descriptor.flags & receive_flag::kWrap) | receive_flag::kLast);
  }

  Receiving ring_{descriptors_, receive_buffers_, cache_};
};

TEST_F(Receive, StartsWithEveryBufferTheControllersAndOneWrap) {
  for (std::size_t index = 0; index < kFrames; ++index) {
    const bool last = index == kFrames - 1;
    EXPECT_EQ(descriptors_[index].flags, last ? 0xa000 : 0x8000);
    EXPECT_EQ(descriptors_[index].buffer,
              machine::bus_address(receive_buffers_[index * Receiving::kBufferBytes]));
  }
  EXPECT_FALSE(ring_.filled());
}

TEST_F(Receive, StartHandsOverWithTheOwnerBitLast) {
  ring_.start();
  EXPECT_TRUE(owner_bit_comes_last(receive_flag::kEmpty, descriptors_));
}

TEST_F(Receive, ShowsBuffersInOrderRoundAndRound) {
  for (std::size_t count = 0; count < 3 * kFrames; ++count) {
    const std::size_t index = count % kFrames;
    fill(index, static_cast<std::uint16_t>(64 + count));
    ASSERT_TRUE(ring_.filled());
    EXPECT_EQ(ring_.descriptor().length, 64 + count);
    EXPECT_EQ(ring_.buffer().data(), &receive_buffers_[index * Receiving::kBufferBytes]);
    ring_.recycle();
    EXPECT_EQ(descriptors_[index].flags, index == kFrames - 1 ? 0xa000 : 0x8000);
    EXPECT_FALSE(ring_.filled());
  }
  EXPECT_TRUE(owner_bit_comes_last(receive_flag::kEmpty, descriptors_));
}

class Transmit : public Rings {
 protected:
  Transmit() {
    ring_.start();
    recorder.reset();
  }

  void finish(std::size_t index) {
    descriptors_[index].flags &= static_cast<std::uint16_t>(~transmit_flag::kReady);
  }

  Sending ring_{descriptors_, transmit_buffers_, cache_};
};

TEST_F(Transmit, ACommittedFrameIsNotTheControllersYet) {
  ring_.commit(100);
  EXPECT_EQ(descriptors_[0].length, 100);
  EXPECT_EQ(descriptors_[0].flags & transmit_flag::kReady, 0);
  EXPECT_EQ(ring_.order().queued(), 1u);
  EXPECT_EQ(ring_.order().in_flight(), 0u);
}

TEST_F(Transmit, HandsOverOldestFirstAndNoMoreThanAsked) {
  ring_.commit(100);
  ring_.commit(101);
  ring_.commit(102);
  EXPECT_EQ(ring_.hand_over_queued(2), 2u);
  EXPECT_EQ(descriptors_[0].flags, 0x8c00);  // R, L, TC
  EXPECT_EQ(descriptors_[1].flags, 0x8c00);
  EXPECT_EQ(descriptors_[2].flags, 0x0000);
  EXPECT_EQ(ring_.hand_over_queued(2), 1u);
  EXPECT_EQ(ring_.hand_over_queued(2), 0u);
  EXPECT_TRUE(owner_bit_comes_last(transmit_flag::kReady, descriptors_));
}

TEST_F(Transmit, IsFullWithEveryBufferQueuedOrInFlight) {
  for (std::size_t count = 0; count < kFrames; ++count) {
    EXPECT_NE(ring_.order().room(), 0u);
    ring_.commit(60);
  }
  EXPECT_EQ(ring_.order().room(), 0u);
  ring_.hand_over_queued(kFrames);
  EXPECT_EQ(ring_.order().room(), 0u);
  EXPECT_EQ(descriptors_[kFrames - 1].flags, 0xac00);  // with W
  ring_.reclaim();
  EXPECT_EQ(ring_.order().room(), 0u) << "nothing has been sent";
  finish(0);
  ring_.reclaim();
  EXPECT_NE(ring_.order().room(), 0u);
}

TEST_F(Transmit, ReclaimsInOrderOnly) {
  ring_.commit(60);
  ring_.commit(60);
  ring_.hand_over_queued(2);
  finish(1);
  ring_.reclaim();
  EXPECT_EQ(ring_.order().in_flight(), 2u) << "the oldest is still on the way";
  finish(0);
  ring_.reclaim();
  EXPECT_EQ(ring_.order().in_flight(), 0u);
}

// Every mixture of queueing, handing over and finishing: the counts never leave their bounds and
// the buffers come in the order of the ring.
TEST_F(Transmit, CountsStayInBoundsInEveryMixture) {
  std::uint32_t random = 1;
  std::size_t next = 0;
  std::size_t oldest = 0;
  for (int step = 0; step < 20'000; ++step) {
    random = random * 1'664'525 + 1'013'904'223;
    const std::uint32_t dice = random >> 30;
    if (dice == 0 && ring_.order().room() != 0) {
      ASSERT_EQ(ring_.buffer().data(), &transmit_buffers_[next * Sending::kBufferBytes]);
      ring_.commit(60);
      next = (next + 1) % kFrames;
    } else if (dice == 1) {
      ring_.hand_over_queued((random >> 20) % 3);
    } else if (dice == 2 && ring_.order().in_flight() != 0) {
      finish(oldest);
      oldest = (oldest + 1) % kFrames;
      ring_.reclaim();
    }
    ASSERT_LE(ring_.order().queued() + ring_.order().in_flight(), kFrames);
  }
}

}  // namespace
}  // namespace iog::imx6
