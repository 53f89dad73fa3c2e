// The common code of this board's UARTs, and the console: UART2, 115200 baud, eight bits, no
// parity. Satisfies hal::Console. UART1 sends the grid (serial_link.hpp).
//
// On the SABRE Lite, UART2 is the connector that U-Boot uses. In QEMU, it is the second -serial
// option.
#pragma once

#include <string_view>

#include "registers/uart.hpp"

namespace iog::imx6 {

inline constexpr std::uint32_t kUartClockHz = 80'000'000;  // PLL3 / 6; clocks.cpp sets the divider

// Fractional divider of the UART: baud = clock / 16 * (UBIR + 1) / (UBMR + 1).
struct BaudDivider {
  std::uint32_t ubir;
  std::uint32_t ubmr;
};

// The exact divider, or the zero divider if none fits the 16-bit registers.
consteval BaudDivider exact_baud_divider(std::uint64_t clock_hz, std::uint64_t baud) {
  std::uint64_t numerator = 16 * baud;
  std::uint64_t denominator = clock_hz;
  std::uint64_t a = numerator;
  std::uint64_t b = denominator;
  while (b != 0) {
    const std::uint64_t remainder = a % b;
    a = b;
    b = remainder;
  }
  numerator /= a;
  denominator /= a;
  const bool fits = numerator <= 0x10000 && denominator <= 0x10000;
  return fits ? BaudDivider{static_cast<std::uint32_t>(numerator - 1),
                            static_cast<std::uint32_t>(denominator - 1)}
              : BaudDivider{0, 0};
}

// Whether this divider results in exactly this rate.
consteval bool is_exact(BaudDivider divider, std::uint64_t clock_hz, std::uint64_t baud) {
  return clock_hz * (divider.ubir + 1) == baud * 16 * (divider.ubmr + 1);
}

// Sets up a UART for eight bits without parity or handshake, regardless of the boot loader's
// settings. transmit_trigger: the bits of UFCR for the fill level below which the transmitter is
// ready.
void start_uart(UartRegisters& registers, const BaudDivider& divider,
                std::uint32_t transmit_trigger);

class Uart {
 public:
  static constexpr std::uint32_t kBaud = 115'200;

  explicit Uart(UartRegisters& registers) : registers_(registers) {}

  void start();

  // Sends the text, with "\r\n" for each "\n". Waits while the transmitter makes progress. If it
  // makes none, drops the rest of the text.
  void write(std::string_view text);

  // Waits until the last bit is sent, bounded like write(). Call it before a reset.
  void flush();

 private:
  bool put(char character);

  UartRegisters& registers_;
};

}  // namespace iog::imx6
