// The management bus of the PHY, by the ENET's MMFR register.
#pragma once

#include <cstdint>
#include <optional>

#include "registers/enet.hpp"

namespace iog::imx6 {

class Mdio {
 public:
  explicit Mdio(EnetRegisters& registers) : registers_(registers) {}

  // Clocks the bus at no more than the 2.5 MHz of IEEE 802.3. Also after a reset of the controller,
  // which ends an access that has begun.
  void start();

  // Whom every access from here on is for, 0 to 31.
  void select(unsigned phy_address) { phy_address_ = phy_address; }

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
  unsigned phy_address_ = 6;  // as U-Boot finds the SABRE Lite's; QEMU's answers there, too
};

}  // namespace iog::imx6
