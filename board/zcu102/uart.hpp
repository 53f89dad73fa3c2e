// What the UARTs have in common, and the console: UART0, 115200 baud, eight bits, no parity.
// Satisfies hal::Console. On the ZCU102 it is the first port of the USB connector J83; QEMU shows
// it as its first -serial.
#pragma once

#include <string_view>

#include "registers/uart.hpp"

namespace iog::zcu102 {

// The reference clock, as the FSBL of the board sets it.
inline constexpr std::uint32_t kUartClockHz = 100'000'000;
inline constexpr std::uint32_t kBaud = 115'200;

// Sets a UART up, whatever a loader left in it; nothing is received.
void start_uart(UartRegisters& registers);

class Uart {
 public:
  explicit Uart(UartRegisters& registers) : registers_(registers) {}

  void start() { start_uart(registers_); }

  // Sends the text, "\n" as "\r\n". Waits for the transmitter as long as it makes progress; if it
  // does not, the rest of the text is dropped.
  void write(std::string_view text);

  // Waits until the last bit has left, bounded like write(). For the moment before a reset.
  void flush();

 private:
  bool put(char character);

  UartRegisters& registers_;
};

}  // namespace iog::zcu102
