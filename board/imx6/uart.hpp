// Contains the common code of this board's UARTs, and the console. The console is UART2 at 115200
// baud, with eight bits and no parity. It satisfies hal::Console. UART1 sends the grid
// (serial_link.hpp).
//
// On the SABRE Lite, UART2 is the connector that U-Boot uses. In QEMU, UART2 is the second -serial
// option.
#pragma once

#include <string_view>

#include "registers/uart.hpp"

namespace iog::imx6 {

inline constexpr std::uint32_t kUartClockHz = 80'000'000;  // PLL3 / 6; clocks.cpp sets the divider

// The fractional divider of the UART: baud = clock / 16 * (UBIR + 1) / (UBMR + 1).
struct BaudDivider {
  std::uint32_t ubir;
  std::uint32_t ubmr;
};

// Returns the exact divider, or the zero divider if no exact divider fits the 16-bit registers.
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

// Returns true if the divider results in exactly this baud rate.
consteval bool is_exact(BaudDivider divider, std::uint64_t clock_hz, std::uint64_t baud) {
  return clock_hz * (divider.ubir + 1) == baud * 16 * (divider.ubmr + 1);
}

// Sets up a UART for eight bits without parity or handshake, regardless of the boot loader's
// settings. `transmit_trigger` contains the bits of UFCR for the fill level below which the
// transmitter is ready.
void start_uart(UartRegisters& registers, const BaudDivider& divider,
                std::uint32_t transmit_trigger);

class Uart {
 public:
  static constexpr std::uint32_t kBaud = 115'200;

  explicit Uart(UartRegisters& registers) : registers_(registers) {}

  void start();

  // Sends the text, with "\r\n" for each "\n". The function waits while the transmitter makes
  // progress. If the transmitter makes no progress, the function drops the rest of the text.
  void write(std::string_view text);

  // Waits until the last bit is sent. The wait is bounded in the same way as in write(). Call this
  // function before a reset.
  void flush();

 private:
  bool put(char character);

  UartRegisters& registers_;
};

}  // namespace iog::imx6
