#include "serial_link.hpp"

#include <bit>

#include "hal/serial_port.hpp"

namespace iog::zcu102 {

static_assert(hal::SerialPort<SerialLink>);
static_assert(std::has_single_bit(SerialLink::kRingBytes));

void SerialLink::write(std::span<const std::byte> bytes) {
  for (const std::byte byte : bytes) {
    ring_[queued_++ % kRingBytes] = byte;
  }
  pump();
}

void SerialLink::pump() {
  for (unsigned free = kFifoBytes; free > 0 && sent_ != queued_; --free) {
    if ((registers_.channel_status.read() & UartRegisters::kStatusTransmitFull) != 0) {
      return;
    }
    registers_.fifo.write(std::to_integer<std::uint32_t>(ring_[sent_++ % kRingBytes]));
  }
}

}  // namespace iog::zcu102
