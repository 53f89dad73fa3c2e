// KSZ9021 by its data sheet (Micrel KSZ9021RL/RN), sections "MMD and extended registers", "RGMII
// pad skew registers".
#include "ethernet/phy.hpp"

#include <array>

namespace iog::imx6::phy {
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

}  // namespace

std::uint32_t start(Mdio& mdio) {
  const std::uint32_t high = mdio.read(kIdHigh).value_or(0xffff);
  const std::uint32_t low = mdio.read(kIdLow).value_or(0xffff);
  const std::uint32_t id = high << 16 | low;
  if ((id & kIdWithoutRevision) != kKsz9021Id) {
    return id;  // QEMU's PHY has no RGMII to delay
  }
  for (const Skew& skew : kSkews) {
    // A failed write shows as a link that loses frames; there is nothing else to do about it here.
    static_cast<void>(mdio.write(
        kExtendedControl, static_cast<std::uint16_t>(kExtendedWriteBit | skew.extended_register)));
    static_cast<void>(mdio.write(kExtendedWrite, skew.value));
  }
  return id;
}

}  // namespace iog::imx6::phy
