// The management bus of the PHY, by the ENET's MMFR register.
#pragma once

#include <cstdint>
#include <optional>

#include "registers/enet.hpp"

namespace iog::imx6 {

class Mdio {
 public:
  // Where the SABRE Lite's straps put its KSZ9021; QEMU answers at the same address.
  static constexpr unsigned kPhyAddress = 6;

  explicit Mdio(EnetRegisters& registers) : registers_(registers) {}

  // Clocks the bus at no more than the 2.5 MHz of IEEE 802.3.
  void start();

  // One access after the other, bounded waits (27 us each on the board). For start-up.
  std::optional<std::uint16_t> read(unsigned phy_register);
  bool write(unsigned phy_register, std::uint16_t value);

  // The same in two halves, for the loop: nothing waits.
  void begin_read(unsigned phy_register);
  bool finished() const { return (registers_.eir.read() & EnetRegisters::kEirMii) != 0; }
  std::uint16_t result() const {
    return static_cast<std::uint16_t>(registers_.mmfr.read() & 0xffff);
  }

 private:
  void begin(std::uint32_t operation, unsigned phy_register, std::uint16_t value);
  bool wait() const;

  EnetRegisters& registers_;
};

}  // namespace iog::imx6
