// The management bus of the PHY, by the GEM's PHY_MANAGEMENT register.
#pragma once

#include <cstdint>

#include "board/common/ethernet/mdio.hpp"
#include "registers/gem.hpp"

namespace iog::zcu102 {

// NETWORK_CONFIG divides the clock by 224: at most 2.5 MHz of any clock up to 560 MHz, 0.45 MHz of
// the 100 MHz that the loaders set.
class ManagementPort {
 public:
  using Registers = GemRegisters;
  // A management frame is 64 bits, 144 us. 10 000 reads of a device are 500 us or more.
  static constexpr unsigned kMaxPolls = 10'000;

  explicit ManagementPort(GemRegisters& registers) : registers_(registers) {}

  // NETWORK_CONFIG and NETWORK_CONTROL have the clock and the switch of this bus; Gem sets
  // both.
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
