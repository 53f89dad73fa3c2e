// Fuse map of the i.MX6DQ (i.MX6DQRM chapter "Fusemap", MAC_ADDR): 48 bits, the first octet on the
// wire in the highest.
#include "mac_fuses.hpp"

namespace iog::imx6 {

std::optional<MacAddress> mac_of_fuses(const OcotpRegisters& ocotp) {
  const std::uint32_t high = ocotp.mac1.read() & 0xffff;
  const std::uint32_t low = ocotp.mac0.read();
  const auto octet = [](std::uint32_t word, unsigned shift) {
    return static_cast<std::uint8_t>(word >> shift & 0xff);
  };
  const MacAddress address{octet(high, 8), octet(high, 0), octet(low, 24),
                           octet(low, 16), octet(low, 8),  octet(low, 0)};
  const bool is_blank = high == 0 && low == 0;
  const bool is_group = (address[0] & 1) != 0;
  if (is_blank || is_group) {
    return std::nullopt;
  }
  return address;
}

}  // namespace iog::imx6
