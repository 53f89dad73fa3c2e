// The MAC address that the board's manufacturer has burnt into the chip's fuses.
#pragma once

#include <optional>

#include "board/common/ethernet/settings.hpp"
#include "registers/ocotp.hpp"

namespace iog::imx6 {

// Returns nothing if the fuses are blank, as in QEMU, or if they contain an address that no station
// can have, that is, a group address or all zeros. Call start_clocks() first.
std::optional<MacAddress> mac_of_fuses(const OcotpRegisters& ocotp);

}  // namespace iog::imx6
