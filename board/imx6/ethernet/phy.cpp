// KSZ9021 by its data sheet (Micrel KSZ9021RL/RN), sections "MMD and extended registers", "RGMII
// pad skew registers".
#include "ethernet/phy.hpp"

#include <array>

namespace iog::imx6 {
namespace {

constexpr std::uint32_t kKsz9021Id = 0x0022'1610;
constexpr std::uint32_t kIdWithoutRevision = 0xffff'fff0;

constexpr unsigned kExtendedControl = 11;
constexpr unsigned kExtendedWrite = 12;
constexpr std::uint16_t kExtendedWriteBit = 1u << 15;

struct Skew {
  std::uint16_t extended_register;
  std::uint16_t value;
};

// RGMII samples data with a clock that is late by about a quarter of its 8 ns. Neither the board's
// traces nor the i.MX6 delay it, so the PHY must: both clocks as late as they go (15 steps of 0.12
// ns), all data and control lines not at all. Four bits a line.
constexpr std::array<Skew, 3> kSkews{{
    {0x104, 0xf0f0},  // RXC, RX_CTL, TXC, TX_CTL from high to low
    {0x105, 0x0000},  // RXD3 to RXD0
    {0x106, 0x0000},  // TXD3 to TXD0
}};

// The board drives PHYAD2 high while the PHY is in reset (pins.cpp). PHYAD1 and PHYAD0 are at the
// LED pins, and what pulls them is the board's affair: U-Boot, too, looks at these four addresses.
constexpr unsigned kFirstAddress = 4;
constexpr unsigned kLastAddress = 7;

// CLK125_NDO of the PHY is the MAC's RGMII transmit clock. As the slave of a 1000BASE-T link the
// PHY makes it of the clock that it recovers from the line, and it jitters too much to transmit by
// (a fault of the KSZ9021 that U-Boot's driver avoids in the same way). So the PHY is always the
// master. With a partner that insists on being the master, too, there is no link at 1000 Mbit/s.
constexpr std::uint16_t kManualMaster = 1u << 12;
constexpr std::uint16_t kMaster = 1u << 11;
constexpr std::uint16_t kMultiport = 1u << 10;  // prefers to be master, where that is negotiated
constexpr std::uint16_t kBeMaster =
    kManualMaster | kMaster | kMultiport | phy::kGigabitFull | phy::kGigabitHalf;

}  // namespace

phy::Identity start_phy(Mdio& mdio) {
  const phy::Identity found = mdio.find(kFirstAddress, kLastAddress);
  if ((found.id & kIdWithoutRevision) != kKsz9021Id) {
    return found;  // QEMU's PHY has no RGMII to delay and no clock to be master of
  }
  for (const Skew& skew : kSkews) {
    mdio.set(kExtendedControl,
             static_cast<std::uint16_t>(kExtendedWriteBit | skew.extended_register));
    mdio.set(kExtendedWrite, skew.value);
  }
  mdio.set(phy::kGigabitControl, kBeMaster);
  mdio.set(phy::kBasicControl, phy::kNegotiateAnew);
  return found;
}

}  // namespace iog::imx6
