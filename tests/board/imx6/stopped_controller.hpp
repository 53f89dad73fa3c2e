// The Ethernet controller stops behind the port's back.
#pragma once

#include "peripherals.hpp"

namespace iog::tests {

inline void stop_controller() { imx6::enet.ecr.clear_bits(imx6::EnetRegisters::kEcrEtherEn); }

}  // namespace iog::tests
