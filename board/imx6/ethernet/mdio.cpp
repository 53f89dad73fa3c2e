// IMX6DQRM, ENET, "MII management frame register" and "MII speed control register".
#include "ethernet/mdio.hpp"

namespace iog::imx6 {
namespace {

using R = EnetRegisters;

// MDC = ipg_clk / (2 (MII_SPEED + 1)): 66 MHz / 28 = 2.36 MHz. HOLDTIME 0 holds MDIO one clock of
// 15 ns, more than the 10 ns of the standard.
constexpr std::uint32_t kIpgHz = 66'000'000;
constexpr std::uint32_t kMdcMaxHz = 2'500'000;
constexpr std::uint32_t kMiiSpeed = (kIpgHz + 2 * kMdcMaxHz - 1) / (2 * kMdcMaxHz) - 1;
static_assert(kMiiSpeed == 13 && kIpgHz / (2 * (kMiiSpeed + 1)) <= kMdcMaxHz);

// A management frame is 64 bits, 27 us. 10 000 reads of a device are 500 us or more.
constexpr unsigned kMaxPolls = 10'000;

}  // namespace

// A speed that comes while MMFR still holds an access sends it once more, and its end would be
// taken for that of the next one. So the clock stops first.
void Mdio::start() {
  registers_.mscr.write(0);
  registers_.mmfr.write(0);
  registers_.mscr.write(kMiiSpeed << 1);
}

std::optional<std::uint16_t> Mdio::read(unsigned phy_register) {
  begin_read(phy_register);
  if (!wait()) {
    return std::nullopt;
  }
  return result();
}

bool Mdio::write(unsigned phy_register, std::uint16_t value) {
  begin(R::kMmfrWrite, phy_register, value);
  return wait();
}

void Mdio::begin_read(unsigned phy_register) { begin(R::kMmfrRead, phy_register, 0); }

void Mdio::begin(std::uint32_t operation, unsigned phy_register, std::uint16_t value) {
  // The flag of the previous access, or the end of this one could not be told.
  registers_.eir.clear(R::kEirMii);
  registers_.mmfr.write(R::kMmfrStart | operation | phy_address_ << R::kMmfrPhyShift |
                        phy_register << R::kMmfrRegisterShift | R::kMmfrTurnaround | value);
}

bool Mdio::wait() const {
  for (unsigned polls = 0; polls < kMaxPolls; ++polls) {
    if (finished()) {
      return true;
    }
  }
  return false;
}

}  // namespace iog::imx6
