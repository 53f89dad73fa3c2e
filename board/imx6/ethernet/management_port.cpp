// IMX6DQRM, ENET, "MII management frame register" and "MII speed control register".
#include "ethernet/management_port.hpp"

namespace iog::imx6 {
namespace {

using R = EnetRegisters;

// MDC = ipg_clk / (2 (MII_SPEED + 1)): 66 MHz / 28 = 2.36 MHz. HOLDTIME 0 holds MDIO one clock of
// 15 ns, more than the 10 ns of the standard.
constexpr std::uint32_t kIpgHz = 66'000'000;
constexpr std::uint32_t kMdcMaxHz = 2'500'000;
constexpr std::uint32_t kMiiSpeed = (kIpgHz + 2 * kMdcMaxHz - 1) / (2 * kMdcMaxHz) - 1;
static_assert(kMiiSpeed == 13 && kIpgHz / (2 * (kMiiSpeed + 1)) <= kMdcMaxHz);

}  // namespace

// A speed that comes while MMFR still holds an access sends it once more, and its end would be
// taken for that of the next one. So the clock stops first.
void ManagementPort::start() {
  registers_.mscr.write(0);
  registers_.mmfr.write(0);
  registers_.mscr.write(kMiiSpeed << 1);
}

void ManagementPort::begin(std::uint32_t frame) {
  // The flag of the previous access, or the end of this one could not be told.
  registers_.eir.clear(R::kEirMii);
  registers_.mmfr.write(frame);
}

}  // namespace iog::imx6
