// The Ethernet controller stops behind the port's back.
#pragma once

#include "peripherals.hpp"

namespace iog::tests {

inline void stop_controller() {
  zcu102::gem3.network_control.clear_bits(zcu102::GemRegisters::kControlTransmit);
}

}  // namespace iog::tests
