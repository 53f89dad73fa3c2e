// Accesses the management bus of the PHY through the GEM's PHY_MANAGEMENT register.
#pragma once

#include <cstdint>

#include "board/common/ethernet/mdio.hpp"
#include "registers/gem.hpp"

namespace iog::zcu102 {

// NETWORK_CONFIG divides the clock by 224. The result is at most 2.5 MHz for any clock up to 560
// MHz, and 0.45 MHz for the 100 MHz that the boot loaders set.
class ManagementPort {
 public:
  using Registers = GemRegisters;
  // A management frame has 64 bits and takes 144 us. Reading a device 10 000 times takes at least
  // 500 us.
  static constexpr unsigned kMaxPolls = 10'000;

  explicit ManagementPort(GemRegisters& registers) : registers_(registers) {}

  // Gem sets the clock in NETWORK_CONFIG and enables this bus in NETWORK_CONTROL.
  void start() {}
  void begin(std::uint32_t frame) { registers_.phy_management.write(frame); }
  bool finished() const {
    return (registers_.network_status.read() & GemRegisters::kNetworkManagementIdle) != 0;
  }
  std::uint16_t data() const {
    return static_cast<std::uint16_t>(registers_.phy_management.read() & 0xffff);
  }

 private:
  GemRegisters& registers_;
};

using Mdio = board::Mdio<ManagementPort>;

}  // namespace iog::zcu102
