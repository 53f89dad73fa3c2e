// MDIO frames, the KSZ9021, and the link monitor, against a PHY made of a table.
#include <array>
#include <gtest/gtest.h>
#include <vector>

#include "board/common/ethernet/link_monitor.hpp"
#include "ethernet/phy.hpp"
#include "trace.hpp"

namespace iog::imx6 {
namespace {

using machine::poke;
using machine::recorder;

class Phy : public testing::Test {
 protected:
  Phy() {
    recorder.reset();
    mdio_.select(address_);
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
    const bool is_ours = (frame >> 23 & 0x1f) == address_;
    if ((frame >> 28 & 3) == 2) {
      // Nobody drives the wire for another address, and a pull-up holds it.
      poke(registers_.mmfr, (frame & 0xffff'0000u) | (is_ours ? table_[number] : 0xffffu));
    }
    poke(registers_.eir, EnetRegisters::kEirMii);
  }

  void be_ksz9021() {
    table_[2] = 0x0022;
    table_[3] = 0x1611;  // revision 1
  }

  // What was written since the last read, without start, operation, address and turnaround.
  struct PhyWrite {
    unsigned phy_register;
    unsigned value;
    bool operator==(const PhyWrite&) const = default;
  };
  [[nodiscard]] std::vector<PhyWrite> writes() const {
    std::vector<PhyWrite> found;
    for (const std::uint32_t frame : frames_) {
      if ((frame >> 28 & 3) == 1) {
        EXPECT_EQ(frame >> 23 & 0x1f, address_);
        found.push_back({frame >> 18 & 0x1f, frame & 0xffff});
      }
    }
    return found;
  }

  // Polls until the monitor has nothing left to read in this round.
  std::optional<Link> round() {
    std::optional<Link> change;
    now_us_ += board::LinkMonitor<Mdio>::kPeriodUs;
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
  board::LinkMonitor<Mdio> monitor_{mdio_};
  std::array<std::uint16_t, 32> table_{};
  std::vector<std::uint32_t> frames_;
  bool alive_ = true;
  std::uint32_t address_ = 6;
  std::uint64_t now_us_ = 0;
};

TEST_F(Phy, TheManagementClockStaysBelow2500Khz) {
  mdio_.start();
  const std::uint32_t speed = machine::peek<std::uint32_t>(registers_.mscr) >> 1;
  EXPECT_EQ(speed, 13u);
  EXPECT_LE(66'000'000u / (2 * (speed + 1)), 2'500'000u);
}

// 802.3 clause 22.2.4.5: ST 01, OP 10 or 01, PHY 00110, register, TA 10, data.
TEST_F(Phy, FramesAreThoseOfClause22) {
  table_[2] = 0x0022;
  EXPECT_EQ(mdio_.read(2), 0x0022);
  EXPECT_TRUE(mdio_.write(11, 0x8104));
  EXPECT_EQ(frames_, (std::vector<std::uint32_t>{0x630a'0000, 0x532e'8104}));
  mdio_.select(5);
  EXPECT_EQ(mdio_.read(2), 0xffff);
  EXPECT_EQ(frames_.back(), 0x628a'0000u) << "PHY 00101";
}

TEST_F(Phy, ADeadBusIsReportedAndDoesNotHang) {
  alive_ = false;
  EXPECT_EQ(mdio_.read(2), std::nullopt);
  EXPECT_FALSE(mdio_.write(11, 0));
  EXPECT_FALSE(start_phy(mdio_).answers());
}

// KSZ9021 data sheet, "Strapping options": PHYAD2 is at RXC, which the board drives; PHYAD1 and 0
// are at the LED pins.
TEST_F(Phy, IsFoundAtEachAddressThatItsStrapsMayGive) {
  be_ksz9021();
  for (address_ = 4; address_ <= 7; ++address_) {
    frames_.clear();
    const phy::Identity found = start_phy(mdio_);
    EXPECT_EQ(found.address, address_);
    EXPECT_EQ(found.id, 0x0022'1611u);
    EXPECT_EQ(writes().size(), 8u) << "to that address";
    plug_in(0x45e1, 0x0800);
    EXPECT_EQ(mdio_.read(phy::kPartnerAbility), 0x45e1) << "and so is what is read later";
    be_ksz9021();
  }
}

TEST_F(Phy, NobodyBetweenTheseAddressesIsSaid) {
  be_ksz9021();
  for (const std::uint32_t elsewhere : {0u, 3u, 8u, 31u}) {
    address_ = elsewhere;
    frames_.clear();
    EXPECT_FALSE(start_phy(mdio_).answers());
    EXPECT_EQ(frames_.size(), 8u) << "two identifiers at each of four addresses";
  }
}

// A bus held low answers with zeros; that is nobody, too (802.3 22.2.4.3.1 has no such identifier).
TEST_F(Phy, ABusHeldLowIsNobody) {
  for (address_ = 4; address_ <= 7; ++address_) {
    EXPECT_FALSE(start_phy(mdio_).answers());
  }
}

TEST_F(Phy, AnotherPhyIsLeftAlone) {
  table_[2] = 0x0007;
  table_[3] = 0xc0d1;  // QEMU's
  const phy::Identity found = start_phy(mdio_);
  EXPECT_EQ(found.address, 6u);
  EXPECT_EQ(found.id, 0x0007'c0d1u);
  EXPECT_TRUE(writes().empty());
}

// Extended registers 0x104 to 0x106 by registers 11 and 12 (data sheet, "MMD and extended
// registers"). Register 9 is of 802.3 40.5.1.1: bit 12 manual, 11 master, 10 multiport device, 9
// and 8 1000BASE-T full and half duplex. Register 0 is of 22.2.4.1: bit 12 negotiation on, 9 anew.
TEST_F(Phy, TheBoardsPhyGetsItsSkewsAndIsMaster) {
  be_ksz9021();
  start_phy(mdio_);
  EXPECT_EQ(writes(), (std::vector<PhyWrite>{{11, 0x8104},
                                             {12, 0xf0f0},
                                             {11, 0x8105},
                                             {12, 0x0000},
                                             {11, 0x8106},
                                             {12, 0x0000},
                                             {9, 0x1f00},
                                             {0, 0x1200}}));
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

// Nobody drives the wire, and a pull-up holds it: all ones are no status with a link in it.
TEST_F(Phy, AStatusOfAllOnesIsNoLink) {
  plug_in(0x45e1, 0x0800);
  EXPECT_TRUE(round()->up);
  table_[phy::kBasicStatus] = 0xffff;
  EXPECT_EQ(round(), Link{});
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
  now_us_ += board::LinkMonitor<Mdio>::kPeriodUs;
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
  now_us_ += board::LinkMonitor<Mdio>::kPeriodUs;
  EXPECT_EQ(monitor_.poll(now_us_), std::nullopt);
  EXPECT_EQ(monitor_.poll(now_us_ + 2999), std::nullopt);
  EXPECT_EQ(monitor_.poll(now_us_ + 3000), Link{});
}

}  // namespace
}  // namespace iog::imx6
