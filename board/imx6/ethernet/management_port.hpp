// The management bus of the PHY, by the ENET's MMFR register.
#pragma once

#include <cstdint>

#include "board/common/ethernet/mdio.hpp"
#include "registers/enet.hpp"

namespace iog::imx6 {

class ManagementPort {
 public:
  using Registers = EnetRegisters;
  // A management frame is 64 bits, 27 us. 10 000 reads of a device are 500 us or more.
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
