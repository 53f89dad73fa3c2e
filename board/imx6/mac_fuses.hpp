// The MAC address that the maker of the board has burnt into the chip's fuses.
#pragma once

#include <optional>

#include "board/common/ethernet/settings.hpp"
#include "registers/ocotp.hpp"

namespace iog::imx6 {

// None if the fuses are blank, as QEMU's are, or hold what cannot be a station's address: a group
// address, or the one of all zeros. Needs the clock of start_clocks().
std::optional<MacAddress> mac_of_fuses(const OcotpRegisters& ocotp);

}  // namespace iog::imx6
