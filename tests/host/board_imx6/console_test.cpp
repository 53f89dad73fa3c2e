// UART2 against the i.MX6DQ manual: dividers, the order of initialisation, characters.
#include <gtest/gtest.h>

#include "text_line.hpp"
#include "trace.hpp"
#include "uart.hpp"

namespace iog::imx6 {
namespace {

using machine::poke;
using machine::recorder;
using machine::Write;

class Console : public testing::Test {
 protected:
  Console() { recorder.reset(); }

  std::string sent() const {
    std::string text;
    for (const Write& write : machine::writes_to(registers_)) {
      if (write.offset == offsetof(UartRegisters, utxd)) {
        text += static_cast<char>(write.value);
      }
    }
    return text;
  }

  UartRegisters registers_{};
  Uart uart_{registers_};
};

// baud = 80 MHz / 16 * (UBIR + 1) / (UBMR + 1), manual, "Binary Rate Multiplier".
TEST(BaudDivider, Gives115200From80MhzExactly) {
  constexpr BaudDivider kDivider = exact_baud_divider(80'000'000, 115'200);
  EXPECT_EQ(kDivider.ubir, 71u);
  EXPECT_EQ(kDivider.ubmr, 3124u);
}

TEST(BaudDivider, SaysWhenNoDividerIsExact) {
  constexpr BaudDivider kDivider = exact_baud_divider(79'999'999, 115'200);
  EXPECT_EQ(kDivider.ubir, 0u);
  EXPECT_EQ(kDivider.ubmr, 0u);
}

TEST_F(Console, StartsInTheOrderOfTheManual) {
  recorder.on_store = [this](const void* address, std::uint32_t value) {
    if (address == &registers_.ucr2 && value == 0) {
      poke(registers_.ucr2, 1u);  // the software reset ends by itself
    }
  };
  uart_.start();
  const std::vector<Write> expected = {
      {0x80, 0x0000},  // UCR1: off
      {0x84, 0x0000},  // UCR2: software reset
      {0x84, 0x4027},  // UCR2: IRTS, WS, TXEN, RXEN, SRST
      {0x88, 0x0004},  // UCR3: RXDMUXSEL
      {0x8c, 0x8000},  // UCR4: CTSTL = 32
      {0x90, 0x0a81},  // UFCR: TXTL = 2, RFDIV = 1, RXTL = 1
      {0xa4, 71},      // UBIR before
      {0xa8, 3124},    // UBMR
      {0x80, 0x0001},  // UCR1: UARTEN
  };
  EXPECT_EQ(machine::writes_to(registers_), expected);
}

TEST_F(Console, SendsALineFeedAsCarriageReturnLineFeed) {
  poke(registers_.usr1, UartRegisters::kUsr1TransmitReady);
  uart_.write("a\nb");
  EXPECT_EQ(sent(), "a\r\nb");
}

TEST_F(Console, DropsTheTextOfADeadTransmitterInsteadOfHanging) {
  uart_.write("nobody hears this");
  EXPECT_EQ(sent(), "");
  uart_.flush();
}

TEST(TextLine, WritesWhatAPersonReads) {
  TextLine line;
  line.text("pc=").hex(0x1010'00ab).text(" n=").decimal(0).text("/").decimal(4'294'967'295u);
  line.text(" ").octet(0x0a).octet(0xf0);
  EXPECT_EQ(line.view(), "pc=101000ab n=0/4294967295 0af0");
}

TEST(TextLine, CutsWhatDoesNotFit) {
  TextLine line;
  for (int count = 0; count < 30; ++count) {
    line.text("0123456789");
  }
  EXPECT_EQ(line.view().size(), 240u);
  EXPECT_EQ(line.decimal(7).view().size(), 240u);
}

}  // namespace
}  // namespace iog::imx6
