// UART2 by IMX6DQRM, chapter "UART", section "Programming the UART in RS-232 mode".
#include "uart.hpp"

#include "hal/console.hpp"

namespace iog::imx6 {

static_assert(hal::Console<Uart>);

namespace {

using R = UartRegisters;

constexpr BaudDivider kDivider = exact_baud_divider(Uart::kClockHz, Uart::kBaud);
static_assert(std::uint64_t{Uart::kClockHz} * (kDivider.ubir + 1) ==
                  std::uint64_t{Uart::kBaud} * 16 * (kDivider.ubmr + 1),
              "115200 baud is exact with the 80 MHz clock");

// One character takes 87 us; a read of a device takes at least 50 ns. 100 000 reads are 5 ms or
// more: longer than the 32 characters of the FIFO need, and short enough for a dead clock to be no
// disaster.
constexpr unsigned kMaxPolls = 100'000;

}  // namespace

void Uart::start() {
  // Switched off first: a loader may be in the middle of a character, and the dividers must not
  // change under a running transmitter.
  registers_.ucr1.write(0);
  // SRST low empties both FIFOs and resets the state machines; it rises by itself after four
  // clocks.
  registers_.ucr2.write(0);
  for (unsigned polls = 0; polls < kMaxPolls; ++polls) {
    if ((registers_.ucr2.read() & R::kUcr2NotReset) != 0) {
      break;
    }
  }
  // RTS is ignored: the console has three wires.
  registers_.ucr2.write(R::kUcr2IgnoreRts | R::kUcr2EightBits | R::kUcr2TxEn | R::kUcr2RxEn |
                        R::kUcr2NotReset);
  // RXDMUXSEL: the manual wants it set in this chip, or the receiver is not connected to its pad.
  registers_.ucr3.write(R::kUcr3RxdMuxSel);
  registers_.ucr4.write(R::kUcr4CtsTrigger32);
  // RFDIV before the ratio: UBIR and UBMR divide what RFDIV leaves.
  registers_.ufcr.write(R::kUfcrTxTrigger2 | R::kUfcrDivideBy1 | R::kUfcrRxTrigger1);
  // UBIR before UBMR: writing UBMR is what makes both take effect.
  registers_.ubir.write(kDivider.ubir);
  registers_.ubmr.write(kDivider.ubmr);
  registers_.ucr1.write(R::kUcr1UartEn);
}

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
