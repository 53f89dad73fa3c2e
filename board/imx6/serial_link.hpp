// The serial link that carries the grid uses UART1 at 115200 baud, with eight bits, no parity, and
// transmission only. The class satisfies hal::SerialPort.
//
// On the SABRE Lite, UART1 is the RS-232 connector next to the console's connector. In QEMU, UART1
// is the first -serial option.
//
// Bytes wait in a ring. The transmitter's FIFO holds 32 bytes, which take 2.8 ms to send. The
// transmitter raises an interrupt when fewer than 16 bytes are left, which last for 1.3 ms. While
// bytes wait, this interrupt ends WFI (gic.hpp). The link therefore stays busy even if the FIFO
// would be empty before the next tick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "registers/uart.hpp"

namespace iog::imx6 {

class SerialLink {
 public:
  static constexpr std::uint32_t kBaud = 115'200;
  static constexpr std::size_t kRingBytes = 4096;

  explicit SerialLink(UartRegisters& registers) : registers_(registers) {}

  void start();

  // A byte takes ten bits on the wire: a start bit, eight data bits and a stop bit.
  std::uint32_t bytes_per_second() const { return kBaud / 10; }

  std::size_t free_bytes() const { return kRingBytes - (queued_ - sent_); }
  void write(std::span<const std::byte> bytes);

  // Writes at most 16 bytes to the FIFO. If no bytes can be sent, the function reads at most one
  // register.
  void pump();

 private:
  void wake_when_ready(bool is_on);

  UartRegisters& registers_;
  // The numbers of bytes since start-up. The counts wrap, which does not affect positions in the
  // ring, because the length of the ring is a power of two.
  std::uint32_t queued_ = 0;
  std::uint32_t sent_ = 0;
  bool wakes_when_ready_ = false;
  std::array<std::byte, kRingBytes> ring_{};
};

}  // namespace iog::imx6
