// The MAC address of the fuses against the i.MX6DQ manual: 00:19:b8 is Boundary Devices' part of
// the IEEE's registry.
#include "mac_fuses.hpp"

#include <gtest/gtest.h>

#include "trace.hpp"

namespace iog::imx6 {
namespace {

using machine::poke;

std::optional<MacAddress> address_of(std::uint32_t mac1, std::uint32_t mac0) {
  OcotpRegisters ocotp{};
  poke(ocotp.mac1, mac1);
  poke(ocotp.mac0, mac0);
  return mac_of_fuses(ocotp);
}

TEST(MacFuses, HoldTheFirstOctetHighest) {
  EXPECT_EQ(address_of(0x0000'0019, 0xb801'0203), (MacAddress{0x00, 0x19, 0xb8, 0x01, 0x02, 0x03}));
  // The upper half of MAC1 is not of this address.
  EXPECT_EQ(address_of(0xffff'0019, 0xb801'0203), (MacAddress{0x00, 0x19, 0xb8, 0x01, 0x02, 0x03}));
}

TEST(MacFuses, BlankOnesAndGroupsAreNoAddress) {
  EXPECT_EQ(address_of(0, 0), std::nullopt);
  EXPECT_EQ(address_of(0xffff'0000, 0), std::nullopt);
  EXPECT_EQ(address_of(0x0000'0119, 0xb801'0203), std::nullopt);
  EXPECT_EQ(address_of(0xffff'ffff, 0xffff'ffff), std::nullopt);
}

}  // namespace
}  // namespace iog::imx6
