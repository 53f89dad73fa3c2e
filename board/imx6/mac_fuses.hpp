// The MAC address that the board's manufacturer has burnt into the chip's fuses.
#pragma once

#include <optional>

#include "board/common/ethernet/settings.hpp"
#include "registers/ocotp.hpp"

namespace iog::imx6 {

// Empty if the fuses are blank, as in QEMU, or contain an address that no station can have: a group
// address or all zeros. Requires start_clocks().
std::optional<MacAddress> mac_of_fuses(const OcotpRegisters& ocotp);

}  // namespace iog::imx6
