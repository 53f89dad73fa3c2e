// MDIO frames, the KSZ9021, and the link monitor, against a PHY made of a table.
#include <array>
#include <gtest/gtest.h>
#include <vector>

#include "ethernet/link_monitor.hpp"
#include "ethernet/mdio.hpp"
#include "ethernet/phy.hpp"
#include "trace.hpp"

namespace iog::imx6 {
namespace {

using machine::peek;
using machine::poke;
using machine::recorder;

class Phy : public testing::Test {
 protected:
  Phy() {
    recorder.reset();
    recorder.on_store = [this](const void* address, std::uint32_t value) {
      if (address == &registers_.eir) {
        poke(registers_.eir, 0u);  // writing the flag clears it
      }
      if (address == &registers_.mmfr && alive_) {
        answer(value);
      }
    };
  }

  void answer(std::uint32_t frame) {
    frames_.push_back(frame);
    const std::uint32_t number = frame >> 18 & 0x1f;
    if ((frame >> 28 & 3) == 2) {
      poke(registers_.mmfr, (frame & 0xffff'0000u) | table_[number]);
    }
    poke(registers_.eir, EnetRegisters::kEirMii);
  }

  // Polls until the monitor has nothing left to read in this round.
  std::optional<Link> round() {
    std::optional<Link> change;
    now_us_ += LinkMonitor::kPeriodUs;
    for (int poll = 0; poll < 10; ++poll) {
      if (const std::optional<Link> now = monitor_.poll(++now_us_)) {
        change = now;
      }
    }
    return change;
  }

  void plug_in(std::uint16_t partner, std::uint16_t gigabit_status) {
    table_[phy::kBasicStatus] = 0x796d;
    table_[phy::kAdvertised] = 0x01e1;
    table_[phy::kPartnerAbility] = partner;
    table_[phy::kGigabitControl] = 0x0300;
    table_[phy::kGigabitStatus] = gigabit_status;
  }

  EnetRegisters registers_{};
  Mdio mdio_{registers_};
  LinkMonitor monitor_{mdio_};
  std::array<std::uint16_t, 32> table_{};
  std::vector<std::uint32_t> frames_;
  bool alive_ = true;
  std::uint64_t now_us_ = 0;
};

TEST_F(Phy, TheManagementClockStaysBelow2500Khz) {
  mdio_.start();
  const std::uint32_t speed = peek<std::uint32_t>(registers_.mscr) >> 1;
  EXPECT_EQ(speed, 13u);
  EXPECT_LE(66'000'000u / (2 * (speed + 1)), 2'500'000u);
}

// 802.3 clause 22.2.4.5: ST 01, OP 10 or 01, PHY 00110, register, TA 10, data.
TEST_F(Phy, FramesAreThoseOfClause22) {
  table_[2] = 0x0022;
  EXPECT_EQ(mdio_.read(2), 0x0022);
  EXPECT_TRUE(mdio_.write(11, 0x8104));
  EXPECT_EQ(frames_, (std::vector<std::uint32_t>{0x630a'0000, 0x532e'8104}));
}

TEST_F(Phy, ADeadBusIsReportedAndDoesNotHang) {
  alive_ = false;
  EXPECT_EQ(mdio_.read(2), std::nullopt);
  EXPECT_FALSE(mdio_.write(11, 0));
  EXPECT_EQ(phy::start(mdio_), 0xffff'ffffu);
}

TEST_F(Phy, OnlyTheBoardsPhyGetsItsSkews) {
  table_[2] = 0x0007;
  table_[3] = 0xc0d1;  // QEMU's
  EXPECT_EQ(phy::start(mdio_), 0x0007'c0d1u);
  EXPECT_EQ(frames_.size(), 2u);

  frames_.clear();
  table_[2] = 0x0022;
  table_[3] = 0x1611;  // KSZ9021, revision 1
  EXPECT_EQ(phy::start(mdio_), 0x0022'1611u);
  const std::vector<std::uint32_t> written(frames_.begin() + 2, frames_.end());
  EXPECT_EQ(written, (std::vector<std::uint32_t>{0x532e'8104, 0x5332'f0f0, 0x532e'8105, 0x5332'0000,
                                                 0x532e'8106, 0x5332'0000}));
}

// 802.3 annex 28B.3: the best both can do.
TEST(Resolve, TakesTheBestOfBothEnds) {
  using Speed = Link::Speed;
  EXPECT_EQ(phy::resolve(0x01e1, 0x01e1, 0x0300, 0x0800), (Link{true, Speed::k1000, true}));
  EXPECT_EQ(phy::resolve(0x01e1, 0x01e1, 0x0300, 0x0400), (Link{true, Speed::k1000, false}));
  EXPECT_EQ(phy::resolve(0x01e1, 0x01e1, 0x0000, 0x0c00), (Link{true, Speed::k100, true}));
  EXPECT_EQ(phy::resolve(0x01e1, 0x00a1, 0x0300, 0x0000), (Link{true, Speed::k100, false}));
  EXPECT_EQ(phy::resolve(0x01e1, 0x0061, 0x0300, 0x0000), (Link{true, Speed::k10, true}));
  EXPECT_EQ(phy::resolve(0x01e1, 0x0021, 0x0300, 0x0000), (Link{true, Speed::k10, false}));
}

TEST_F(Phy, TheMonitorReportsChangesOnly) {
  EXPECT_EQ(round(), std::nullopt) << "down from the start";
  plug_in(0x45e1, 0x0800);
  EXPECT_EQ(round(), (Link{true, Link::Speed::k1000, true}));
  EXPECT_EQ(round(), std::nullopt);
  table_[phy::kBasicStatus] = 0x7949;
  EXPECT_EQ(round(), Link{});
  EXPECT_FALSE(monitor_.link().up);
  plug_in(0x0061, 0);
  EXPECT_EQ(round(), (Link{true, Link::Speed::k10, true}));
}

TEST_F(Phy, TheMonitorAsksOncePerPollAndOncePerPeriod) {
  plug_in(0x45e1, 0x0800);
  round();
  frames_.clear();
  now_us_ += LinkMonitor::kPeriodUs;
  for (int poll = 0; poll < 100; ++poll) {
    const std::size_t before = frames_.size();
    monitor_.poll(++now_us_);
    EXPECT_LE(frames_.size(), before + 1);
  }
  EXPECT_EQ(frames_.size(), 1u);
}

TEST_F(Phy, ABusThatDiesTakesTheLinkDown) {
  plug_in(0x45e1, 0x0800);
  round();
  alive_ = false;
  now_us_ += LinkMonitor::kPeriodUs;
  EXPECT_EQ(monitor_.poll(now_us_), std::nullopt);
  EXPECT_EQ(monitor_.poll(now_us_ + 2999), std::nullopt);
  EXPECT_EQ(monitor_.poll(now_us_ + 3000), Link{});
}

}  // namespace
}  // namespace iog::imx6
