// The serial link that carries the grid uses UART1 for transmission only. The class satisfies
// hal::SerialPort. In QEMU, UART1 is the second -serial option.
//
// Bytes wait in a ring. The transmitter's FIFO holds 64 bytes, which take 5.6 ms to send. The loop
// runs every millisecond, so the link stays busy without an interrupt.
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

  // Writes at most 64 bytes to the FIFO. If no bytes wait, the function accesses no register.
  void pump();

 private:
  UartRegisters& registers_;
  // The numbers of bytes since start-up. The counts wrap, which does not affect positions in the
  // ring, because the length of the ring is a power of two.
  std::uint32_t queued_ = 0;
  std::uint32_t sent_ = 0;
  std::array<std::byte, kRingBytes> ring_{};
};

}  // namespace iog::zcu102
