// Accesses the management bus of the PHY through the ENET's MMFR register.
#pragma once

#include <cstdint>

#include "board/common/ethernet/mdio.hpp"
#include "registers/enet.hpp"

namespace iog::imx6 {

class ManagementPort {
 public:
  using Registers = EnetRegisters;
  // A management frame has 64 bits and takes 27 us. Reading a device 10 000 times takes at least
  // 500 us.
  static constexpr unsigned kMaxPolls = 10'000;

  explicit ManagementPort(EnetRegisters& registers) : registers_(registers) {}

  void start();
  void begin(std::uint32_t frame);
  bool finished() const { return (registers_.eir.read() & EnetRegisters::kEirMii) != 0; }
  std::uint16_t data() const { return static_cast<std::uint16_t>(registers_.mmfr.read() & 0xffff); }

 private:
  EnetRegisters& registers_;
};

using Mdio = board::Mdio<ManagementPort>;

}  // namespace iog::imx6
