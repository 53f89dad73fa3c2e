// The serial link that carries the grid: UART1, 115200 baud, eight bits, no parity, transmit only.
// Satisfies hal::SerialPort.
//
// On the SABRE Lite, UART1 is the RS-232 connector next to the console's. In QEMU, it is the first
// -serial option.
//
// Bytes wait in a ring. The transmitter's FIFO holds 32 of them, which take 2.8 ms to send. It
// raises an interrupt when fewer than 16 are left, which last for 1.3 ms. While bytes wait, this
// interrupt ends WFI (gic.hpp). The link therefore stays busy even if the FIFO would be empty
// before the next tick.
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

  // Fills the FIFO, at most 16 bytes. If there is nothing to do, reads only one register.
  void pump();

 private:
  void wake_when_ready(bool is_on);

  UartRegisters& registers_;
  // Bytes since start-up. The counts wrap, which does not affect positions in the ring, because its
  // length is a power of two.
  std::uint32_t queued_ = 0;
  std::uint32_t sent_ = 0;
  bool wakes_when_ready_ = false;
  std::array<std::byte, kRingBytes> ring_{};
};

}  // namespace iog::imx6
