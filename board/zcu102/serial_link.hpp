// The serial link that carries the grid: UART1, transmit only. Satisfies hal::SerialPort. In QEMU,
// it is the second -serial option.
//
// Bytes wait in a ring. The transmitter's FIFO holds 64 of them, which take 5.6 ms to send. The
// loop runs every millisecond, so the link stays busy without an interrupt.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "uart.hpp"

namespace iog::zcu102 {

class SerialLink {
 public:
  static constexpr std::size_t kRingBytes = 4096;
  static constexpr unsigned kFifoBytes = 64;

  explicit SerialLink(UartRegisters& registers) : registers_(registers) {}

  void start() { start_uart(registers_); }

  // A byte takes ten bits on the wire: a start bit, eight data bits and a stop bit.
  std::uint32_t bytes_per_second() const { return kBaud / 10; }

  std::size_t free_bytes() const { return kRingBytes - (queued_ - sent_); }
  void write(std::span<const std::byte> bytes);

  // Fills the FIFO, at most 64 bytes. If there is nothing to do, accesses no register.
  void pump();

 private:
  UartRegisters& registers_;
  // Bytes since start-up. The counts wrap, which does not affect positions in the ring, because its
  // length is a power of two.
  std::uint32_t queued_ = 0;
  std::uint32_t sent_ = 0;
  std::array<std::byte, kRingBytes> ring_{};
};

}  // namespace iog::zcu102
