// The search for the PHY and the registers of the DP83867 (TI SNLS484), against a PHY made of a
// table.
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "ethernet/phy.hpp"
#include "trace.hpp"

namespace iog::zcu102 {
namespace {

class Dp83867 : public testing::Test {
 protected:
  Dp83867() {
    machine::recorder.reset();
    machine::poke(registers_.network_status, 4u);  // idle
    machine::recorder.on_store = [this](const void* /*address*/, std::uint32_t frame) {
      frames_.push_back(frame);
      if ((frame >> 23 & 31) == address_) {
        answer(frame);
      } else if ((frame >> 28 & 3) == 2) {
        machine::poke(registers_.phy_management, 0xffffu);
      }
    };
  }

  // Registers 13 and 14 lead to the extended ones: 802.3 annex 22D, device 31.
  void answer(std::uint32_t frame) {
    const std::uint32_t number = frame >> 18 & 31;
    std::uint16_t& value =
        number == 14 && table_[13] == 0x401f ? extended_[selected_] : table_[number];
    if ((frame >> 28 & 3) == 2) {
      machine::poke(registers_.phy_management, std::uint32_t{value});
      return;
    }
    value = static_cast<std::uint16_t>(frame);
    selected_ = number == 14 && table_[13] == 0x001f ? value : selected_;
  }

  GemRegisters registers_{};
  Mdio mdio_{registers_};
  std::map<std::uint32_t, std::uint16_t> table_;
  std::map<std::uint16_t, std::uint16_t> extended_;
  std::vector<std::uint32_t> frames_;
  std::uint16_t selected_ = 0;
  std::uint32_t address_ = 12;
};

// 802.3 clause 22.2.4.5: ST 01, OP 10 or 01, PHY, register, TA 10, data.
TEST_F(Dp83867, FramesAreThoseOfClause22) {
  mdio_.select(12);
  table_[2] = 0x2000;
  EXPECT_EQ(mdio_.read(2), 0x2000);
  EXPECT_TRUE(mdio_.write(0, 0x1200));
  EXPECT_EQ(frames_, (std::vector<std::uint32_t>{0x660a'0000, 0x5602'1200}));
}

TEST_F(Dp83867, GetsTheDelaysOfTheBoardAndKeepsTheOtherBits) {
  table_ = {{2, 0x2000}, {3, 0xa231}, {0x10, 0xd448}};
  extended_ = {{0x31, 0x10b0}, {0x32, 0x00d0}, {0x86, 0x0077}};
  EXPECT_EQ(start_phy(mdio_).id, 0x2000'a231u);
  EXPECT_EQ(extended_[0x31], 0x1030) << "CFG4: bit 7 off";
  EXPECT_EQ(extended_[0x32], 0x00d3) << "RGMIICTL: both delays on";
  EXPECT_EQ(extended_[0x86], 0x00a8) << "RGMIIDCTL: 2.75 ns out, 2.25 ns in";
  EXPECT_EQ(table_[0x10], 0x5048) << "PHYCR: FIFO of 4, no forced link";
  EXPECT_EQ(table_[9], 0x0200) << "1000 Mbit/s at full duplex only";
  EXPECT_EQ(table_[0], 0x1200) << "negotiates anew";
}

// QEMU's is a Marvell at 23.
TEST_F(Dp83867, AnotherPhyIsFoundAtAnyAddressAndLeftAlone) {
  table_ = {{2, 0x0141}, {3, 0x0cc2}};
  for (const std::uint32_t address : {0u, 12u, 23u, 31u}) {
    address_ = address;
    frames_.clear();
    const phy::Identity found = start_phy(mdio_);
    EXPECT_EQ(found.address, address);
    EXPECT_EQ(found.id, 0x0141'0cc2u);
    EXPECT_EQ(frames_.size(), 2 * (address + 1)) << "nothing but identifiers is read";
  }
}

TEST_F(Dp83867, ADeadBusIsNobodyAndDoesNotHang) {
  machine::poke(registers_.network_status, 0u);
  EXPECT_FALSE(start_phy(mdio_).answers());
  address_ = 32;
  machine::poke(registers_.network_status, 4u);
  EXPECT_FALSE(start_phy(mdio_).answers());
}

}  // namespace
}  // namespace iog::zcu102
