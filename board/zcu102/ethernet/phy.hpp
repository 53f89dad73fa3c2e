// The board's PHY, a TI DP83867IR.
#pragma once

#include "ethernet/management_port.hpp"

namespace iog::zcu102 {

// Finds the PHY at any of the 32 addresses and selects it; every later access of `mdio` is for it.
// If it is the DP83867, sets its RGMII delays and has it negotiate without the half duplex at
// 1000 Mbit/s that the GEM does not have. Bounded.
phy::Identity start_phy(Mdio& mdio);

}  // namespace iog::zcu102
