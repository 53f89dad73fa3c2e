// DP83867IR by its data sheet (TI SNLS484), sections "Extended register space access", "RGMII
// control register (RGMIICTL)", "RGMII delay control register (RGMIIDCTL)", "PHY control register
// (PHYCR)", "Configuration register 4 (CFG4)".
#include "ethernet/phy.hpp"

namespace iog::zcu102 {
namespace {

constexpr std::uint32_t kDp83867Id = 0x2000'a230;
constexpr std::uint32_t kIdWithoutRevision = 0xffff'fff0;

constexpr unsigned kPhyControl = 0x10;
constexpr std::uint16_t kFifoDepth = 3u << 14;
constexpr std::uint16_t kFifoDepth4 = 1u << 14;
constexpr std::uint16_t kForceLinkGood = 1u << 10;

constexpr unsigned kRegisterControl = 0x0d;
constexpr unsigned kAddressOrData = 0x0e;
constexpr std::uint16_t kDevice31Address = 0x001f;
constexpr std::uint16_t kDevice31Data = 0x401f;

constexpr std::uint16_t kCfg4 = 0x0031;
constexpr std::uint16_t kCfg4InternalTest = 1u << 7;
constexpr std::uint16_t kRgmiiControl = 0x0032;
constexpr std::uint16_t kRgmiiDelays = 1u << 1 | 1u << 0;  // transmit, receive
constexpr std::uint16_t kRgmiiDelayControl = 0x0086;
// RGMII samples data with a clock that is late by about a quarter of its 8 ns, and neither the
// board's traces nor the GEM delay it. In steps of 0.25 ns from 0.25 ns on: 2.75 ns when
// transmitting, 2.25 ns when receiving (Linux, zynqmp-zcu102-revA.dts).
constexpr std::uint16_t kDelays = 0xa << 4 | 0x8;

void select_extended(Mdio& mdio, std::uint16_t extended_register) {
  mdio.set(kRegisterControl, kDevice31Address);
  mdio.set(kAddressOrData, extended_register);
  mdio.set(kRegisterControl, kDevice31Data);
}

void change_extended(Mdio& mdio, std::uint16_t extended_register, std::uint16_t clear,
                     std::uint16_t set) {
  select_extended(mdio, extended_register);
  const unsigned before = mdio.read(kAddressOrData).value_or(0);
  mdio.set(kAddressOrData, static_cast<std::uint16_t>((before & ~unsigned{clear}) | set));
}

}  // namespace

phy::Identity start_phy(Mdio& mdio) {
  const phy::Identity found = mdio.find(0, 31);
  if ((found.id & kIdWithoutRevision) != kDp83867Id) {
    return found;  // QEMU's PHY has no RGMII to delay
  }
  // The board straps RX_CTRL to a mode in which the PHY would stay in a test; this bit ends it.
  change_extended(mdio, kCfg4, kCfg4InternalTest, 0);
  change_extended(mdio, kRgmiiControl, 0, kRgmiiDelays);
  change_extended(mdio, kRgmiiDelayControl, 0xff, kDelays);
  const unsigned control = mdio.read(kPhyControl).value_or(0);
  mdio.set(kPhyControl, static_cast<std::uint16_t>(
                            (control & ~unsigned{kFifoDepth | kForceLinkGood}) | kFifoDepth4));
  mdio.set(phy::kGigabitControl, phy::kGigabitFull);
  mdio.set(phy::kBasicControl, phy::kNegotiateAnew);
  return found;
}

}  // namespace iog::zcu102
