#include "serial_link.hpp"

#include <bit>

#include "hal/serial_port.hpp"
#include "uart.hpp"

namespace iog::imx6 {

static_assert(hal::SerialPort<SerialLink>);
static_assert(std::has_single_bit(SerialLink::kRingBytes));

namespace {

using R = UartRegisters;

constexpr BaudDivider kDivider = exact_baud_divider(kUartClockHz, SerialLink::kBaud);
static_assert(is_exact(kDivider, kUartClockHz, SerialLink::kBaud));

// TRDY rises when fewer than 16 of the FIFO's 32 places are taken, so this many fit without a look
// at the FIFO for each.
constexpr std::uint32_t kRefillBytes = 16;

}  // namespace

void SerialLink::start() { start_uart(registers_, kDivider, R::kUfcrTxTrigger16); }

void SerialLink::write(std::span<const std::byte> bytes) {
  for (const std::byte byte : bytes) {
    ring_[queued_ % kRingBytes] = byte;
    ++queued_;
  }
  pump();
}

void SerialLink::pump() {
  const std::uint32_t waiting = queued_ - sent_;
  if (waiting != 0 && (registers_.usr1.read() & R::kUsr1TransmitReady) != 0) {
    const std::uint32_t end = sent_ + (waiting < kRefillBytes ? waiting : kRefillBytes);
    for (; sent_ != end; ++sent_) {
      registers_.utxd.write(std::to_integer<std::uint32_t>(ring_[sent_ % kRingBytes]));
    }
  }
  wake_when_ready(sent_ != queued_);
}

// An empty FIFO is ready, too: with nothing to send it would keep the core from sleeping.
void SerialLink::wake_when_ready(bool is_on) {
  if (is_on != wakes_when_ready_) {
    wakes_when_ready_ = is_on;
    registers_.ucr1.write(R::kUcr1UartEn | (is_on ? R::kUcr1TransmitReadyInterrupt : 0));
  }
}

}  // namespace iog::imx6
