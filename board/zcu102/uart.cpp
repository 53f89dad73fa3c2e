// UARTs by UG1085, chapter "UART Controller".
#include "uart.hpp"

#include "hal/console.hpp"

namespace iog::zcu102 {

static_assert(hal::Console<Uart>);

namespace {

using R = UartRegisters;

// baud = clock / (generator * (divider + 1)): 115,207, of which 0.006 % too much.
constexpr std::uint32_t kGenerator = 124;
constexpr std::uint32_t kDivider = 6;
constexpr std::uint32_t kBaudMade = kUartClockHz / (kGenerator * (kDivider + 1));
static_assert(kBaudMade - kBaud < kBaud / 1000);

// A character takes 87 us; a read of a device at least 50 ns. A thousand reads for each of the 64
// characters of the FIFO, and more.
constexpr unsigned kMaxPolls = 200'000;

}  // namespace

void start_uart(UartRegisters& registers) {
  registers.interrupt_disable.write(0xffff'ffff);
  registers.control.write(R::kControlTransmitOff | R::kControlResetTransmitter |
                          R::kControlResetReceiver);
  registers.baud_generator.write(kGenerator);
  registers.baud_divider.write(kDivider);
  registers.mode.write(R::kModeEightBitsNoParity);
  registers.control.write(R::kControlTransmit | R::kControlReceive);
}

bool Uart::put(char character) {
  for (unsigned polls = 0; polls < kMaxPolls; ++polls) {
    if ((registers_.channel_status.read() & R::kStatusTransmitFull) == 0) {
      registers_.fifo.write(static_cast<unsigned char>(character));
      return true;
    }
  }
  return false;
}

void Uart::write(std::string_view text) {
  for (const char character : text) {
    if ((character == '\n' && !put('\r')) || !put(character)) {
      return;
    }
  }
}

void Uart::flush() {
  for (unsigned polls = 0; polls < kMaxPolls; ++polls) {
    const std::uint32_t status = registers_.channel_status.read();
    if ((status & R::kStatusTransmitEmpty) != 0 && (status & R::kStatusTransmitting) == 0) {
      return;
    }
  }
}

}  // namespace iog::zcu102
