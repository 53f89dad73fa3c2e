// The board's PHY, a Micrel KSZ9021.
#pragma once

#include "ethernet/management_port.hpp"

namespace iog::imx6 {

// Finds the PHY and selects its address for all later accesses of `mdio`. A KSZ9021 gets its RGMII
// delays and negotiates as the master of 1000BASE-T. All waits are bounded.
phy::Identity start_phy(Mdio& mdio);

}  // namespace iog::imx6
