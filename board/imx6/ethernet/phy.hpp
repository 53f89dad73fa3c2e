// The board's PHY, a Micrel KSZ9021.
#pragma once

#include "ethernet/management_port.hpp"

namespace iog::imx6 {

// Finds the PHY and selects its address; every later access of `mdio` is for it. If it is the
// KSZ9021, sets its RGMII delays and has it negotiate as the master of 1000BASE-T. Bounded.
phy::Identity start_phy(Mdio& mdio);

}  // namespace iog::imx6
