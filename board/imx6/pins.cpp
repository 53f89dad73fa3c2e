// IOMUXC by IMX6DQRM, chapter "IOMUX Controller (IOMUXC)". What is wired to what is the SABRE
// Lite's schematic: console on EIM_D26/27, the other RS-232 driver on SD3_DAT7/6, PHY reset on
// EIM_D23 (GPIO3_23), PHY on the RGMII pads.
#include "pins.hpp"

#include <array>
#include <span>

namespace iog::imx6 {
namespace {

// Offsets of a pad's registers. select_offset 0: the pad's input has no daisy chain.
struct Pad {
  std::uint16_t mux_offset;
  std::uint16_t control_offset;
  std::uint8_t alternative;
  std::uint16_t select_offset = 0;
  std::uint8_t select = 0;
};

// Pad control: hysteresis, 100 kOhm pull-up, 40 Ohm drive.
constexpr std::uint32_t kPadPullUp40Ohm = 1u << 16 | 2u << 14 | 1u << 13 | 1u << 12 | 6u << 3;
constexpr std::uint32_t kPad100Mhz = 2u << 6;
constexpr std::uint32_t kPadFastEdge = 1u << 0;
constexpr std::uint32_t kUartPad = kPadPullUp40Ohm | kPad100Mhz | kPadFastEdge;

constexpr std::array<Pad, 2> kConsole{{
    {0x0bc, 0x3d0, 4},            // EIM_D26: UART2_TX_DATA
    {0x0c0, 0x3d4, 4, 0x928, 1},  // EIM_D27: UART2_RX_DATA
}};

constexpr std::array<Pad, 2> kSerial{{
    {0x2a8, 0x690, 1},            // SD3_DAT7: UART1_TX_DATA
    {0x2ac, 0x694, 1, 0x920, 3},  // SD3_DAT6: UART1_RX_DATA
}};

constexpr std::array<Pad, 3> kManagement{{
    {0x1d0, 0x4e4, 1, 0x840, 0},  // ENET_MDIO
    {0x1f4, 0x508, 1},            // ENET_MDC
    {0x1d4, 0x4e8, 1},            // ENET_REF_CLK: 125 MHz from the PHY's CLK125_NDO
}};

constexpr std::array<Pad, 6> kTransmit{{
    {0x058, 0x36c, 1},  // RGMII_TXC
    {0x05c, 0x370, 1},  // RGMII_TD0
    {0x060, 0x374, 1},  // RGMII_TD1
    {0x064, 0x378, 1},  // RGMII_TD2
    {0x068, 0x37c, 1},  // RGMII_TD3
    {0x074, 0x388, 1},  // RGMII_TX_CTL
}};

constexpr std::array<Pad, 6> kReceive{{
    {0x084, 0x398, 1, 0x844, 0},  // RGMII_RXC
    {0x070, 0x384, 1, 0x848, 0},  // RGMII_RD0
    {0x078, 0x38c, 1, 0x84c, 0},  // RGMII_RD1
    {0x07c, 0x390, 1, 0x850, 0},  // RGMII_RD2
    {0x080, 0x394, 1, 0x854, 0},  // RGMII_RD3
    {0x06c, 0x380, 1, 0x858, 0},  // RGMII_RX_CTL
}};

constexpr std::uint8_t kGpio = 5;              // the alternative of every pad that is a GPIO
constexpr std::uint16_t kPhyResetMux = 0x0ac;  // EIM_D23
constexpr std::uint32_t kPhyReset = 1u << 23;  // GPIO3_23, active low
// The receive pads are the PHY's strapping pins while it is in reset. All high: RXC is PHYAD2
// (address 4 to 7, phy.cpp), RD0 to RD3 are MODE 1111 (RGMII, every speed), RX_CTL switches the 125
// MHz output on.
constexpr std::uint32_t kPhyStraps =
    1u << 30 | 1u << 25 | 1u << 27 | 1u << 28 | 1u << 29 | 1u << 24;  // GPIO6

// KSZ9021 data sheet, "Reset timing": 10 ms of stable supply before reset rises; 100 us after it
// before the first MDIO access. Straps are read at the edge and held for nanoseconds.
constexpr std::uint32_t kResetUs = 10'000;
constexpr std::uint32_t kAfterResetUs = 100;

void connect(IomuxcRegisters& iomuxc, std::span<const Pad> pads, std::uint32_t control) {
  for (const Pad& pad : pads) {
    iomuxc.at(pad.mux_offset).write(pad.alternative);
    iomuxc.at(pad.control_offset).write(control);
    if (pad.select_offset != 0) {
      iomuxc.at(pad.select_offset).write(pad.select);
    }
  }
}

}  // namespace

void start_console_pins(IomuxcRegisters& iomuxc) { connect(iomuxc, kConsole, kUartPad); }

void start_serial_pins(IomuxcRegisters& iomuxc) { connect(iomuxc, kSerial, kUartPad); }

void start_ethernet_pins(IomuxcRegisters& iomuxc, GpioRegisters& gpio3, GpioRegisters& gpio6,
                         GptClock& clock) {
  // Levels before directions, directions before multiplexers: no pad ever shows another level.
  gpio3.dr.clear_bits(kPhyReset);
  gpio3.gdir.set_bits(kPhyReset);
  iomuxc.at(kPhyResetMux).write(kGpio);
  gpio6.dr.set_bits(kPhyStraps);
  gpio6.gdir.set_bits(kPhyStraps);
  for (const Pad& pad : kReceive) {
    iomuxc.at(pad.mux_offset).write(kGpio);
  }
  // ENET_CLK_SEL low: the transmit clock comes in at ENET_REF_CLK, the chip's own PLL is not used.
  iomuxc.at(IomuxcRegisters::kGpr1).clear_bits(IomuxcRegisters::kGpr1EnetClkSel);
  connect(iomuxc, kManagement, kPadPullUp40Ohm | kPad100Mhz);
  connect(iomuxc, kTransmit, kPadPullUp40Ohm);

  clock.wait_us(kResetUs);
  gpio3.dr.set_bits(kPhyReset);
  // At once: after its reset the PHY drives these pads, and we must stop driving them.
  connect(iomuxc, kReceive, kPadPullUp40Ohm);
  gpio6.gdir.clear_bits(kPhyStraps);
  clock.wait_us(kAfterResetUs);
}

}  // namespace iog::imx6
