// UARTs by IMX6DQRM, chapter "UART", section "Programming the UART in RS-232 mode".
#include "uart.hpp"

#include "hal/console.hpp"

namespace iog::imx6 {

static_assert(hal::Console<Uart>);

namespace {

using R = UartRegisters;

constexpr BaudDivider kDivider = exact_baud_divider(kUartClockHz, Uart::kBaud);
static_assert(is_exact(kDivider, kUartClockHz, Uart::kBaud),
              "115200 baud is exact with the 80 MHz clock");

// One character takes 87 us; a read of a device takes at least 50 ns. 100 000 reads are 5 ms or
// more: longer than the 32 characters of the FIFO need, and short enough for a dead clock to be no
// disaster.
constexpr unsigned kMaxPolls = 100'000;

}  // namespace

void start_uart(UartRegisters& registers, const BaudDivider& divider,
                std::uint32_t transmit_trigger) {
  // Switched off first: a loader may be in the middle of a character, and the dividers must not
  // change under a running transmitter.
  registers.ucr1.write(0);
  // SRST low empties both FIFOs and resets the state machines; it rises by itself after four
  // clocks.
  registers.ucr2.write(0);
  for (unsigned polls = 0; polls < kMaxPolls; ++polls) {
    if ((registers.ucr2.read() & R::kUcr2NotReset) != 0) {
      break;
    }
  }
  // RTS is ignored: both lines have three wires.
  registers.ucr2.write(R::kUcr2IgnoreRts | R::kUcr2EightBits | R::kUcr2TxEn | R::kUcr2RxEn |
                       R::kUcr2NotReset);
  // RXDMUXSEL: the manual wants it set in this chip, or the receiver is not connected to its pad.
  registers.ucr3.write(R::kUcr3RxdMuxSel);
  registers.ucr4.write(R::kUcr4CtsTrigger32);
  // RFDIV before the ratio: UBIR and UBMR divide what RFDIV leaves.
  registers.ufcr.write(transmit_trigger | R::kUfcrDivideBy1 | R::kUfcrRxTrigger1);
  // UBIR before UBMR: writing UBMR is what makes both take effect.
  registers.ubir.write(divider.ubir);
  registers.ubmr.write(divider.ubmr);
  registers.ucr1.write(R::kUcr1UartEn);
}

void Uart::start() { start_uart(registers_, kDivider, R::kUfcrTxTrigger2); }

bool Uart::put(char character) {
  for (unsigned polls = 0; polls < kMaxPolls; ++polls) {
    // TRDY: the FIFO holds fewer characters than TXTL, so one more always fits.
    if ((registers_.usr1.read() & R::kUsr1TransmitReady) != 0) {
      registers_.utxd.write(static_cast<unsigned char>(character));
      return true;
    }
  }
  return false;
}

void Uart::write(std::string_view text) {
  for (const char character : text) {
    if (character == '\n' && !put('\r')) {
      return;
    }
    if (!put(character)) {
      return;
    }
  }
}

void Uart::flush() {
  for (unsigned polls = 0; polls < kMaxPolls; ++polls) {
    if ((registers_.usr2.read() & R::kUsr2TransmitDone) != 0) {
      return;
    }
  }
}

}  // namespace iog::imx6
