// Contains the common code of the UARTs, and the console. The console is UART0 at 115200 baud, with
// eight bits and no parity. It satisfies hal::Console. On the ZCU102, UART0 is the first port of
// the USB connector J83. In QEMU, UART0 is the first -serial option.
#pragma once

#include <string_view>

#include "registers/uart.hpp"

namespace iog::zcu102 {

// The reference clock that the board's FSBL sets.
inline constexpr std::uint32_t kUartClockHz = 100'000'000;
inline constexpr std::uint32_t kBaud = 115'200;

// Sets up a UART for transmission only, regardless of the boot loader's settings.
void start_uart(UartRegisters& registers);

class Uart {
 public:
  explicit Uart(UartRegisters& registers) : registers_(registers) {}

  void start() { start_uart(registers_); }

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

}  // namespace iog::zcu102
