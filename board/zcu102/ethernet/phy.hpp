// The board's PHY, a TI DP83867IR.
#pragma once

#include "ethernet/management_port.hpp"

namespace iog::zcu102 {

// Finds the PHY at any of the 32 addresses, and selects this PHY for all later accesses of `mdio`.
// A DP83867 gets its RGMII delays and negotiates without half duplex at 1000 Mbit/s, which the GEM
// does not support. All waits are bounded.
phy::Identity start_phy(Mdio& mdio);

}  // namespace iog::zcu102
