// The UART by UG1087, module UART, on a RAM block.
#include "uart.hpp"

#include <array>
#include <gtest/gtest.h>
#include <string>

#include "serial_link.hpp"
#include "trace.hpp"

namespace iog::zcu102 {
namespace {

std::string sent(const UartRegisters& registers) {
  std::string text;
  for (const machine::Write& write : machine::writes_to(registers)) {
    text += write.offset == 0x30 ? std::string(1, static_cast<char>(write.value)) : "";
  }
  return text;
}

// CR: RXRES 0, TXRES 1, RXEN 2, TXEN 4, TXDIS 5. MR 0x20: eight bits, no parity, one stop bit.
TEST(Zcu102Uart, IsOffWhileItsBaudRateChanges) {
  machine::recorder.reset();
  UartRegisters registers{};
  Uart(registers).start();
  const std::vector<machine::Write> expected{{0x0c, 0xffffffff}, {0x00, 0x23}, {0x18, 124},
                                             {0x34, 6},          {0x04, 0x20}, {0x00, 0x14}};
  EXPECT_EQ(machine::writes_to(registers), expected);
}

TEST(Zcu102Uart, SendsLinesAndGivesUpOnATransmitterThatStands) {
  machine::recorder.reset();
  UartRegisters registers{};
  Uart(registers).write("a\nb");
  EXPECT_EQ(sent(registers), "a\r\nb");
  machine::recorder.reset();
  machine::poke(registers.channel_status, std::uint32_t{1} << 4);  // TXFULL, for ever
  Uart(registers).write("lost");
  EXPECT_EQ(sent(registers), "");
}

// The FIFO takes 64 bytes; the ring the rest, for later passes.
TEST(Zcu102SerialLink, FillsTheFifoAndKeepsTheRest) {
  machine::recorder.reset();
  UartRegisters registers{};
  SerialLink link(registers);
  std::array<std::byte, 100> bytes{};
  bytes.fill(std::byte{0x55});
  link.write(bytes);
  EXPECT_EQ(sent(registers).size(), 64u);
  EXPECT_EQ(link.free_bytes(), SerialLink::kRingBytes - 36);
  link.pump();
  EXPECT_EQ(sent(registers).size(), 100u);
  machine::poke(registers.channel_status, std::uint32_t{1} << 4);
  link.write(std::span(bytes).first(1));
  EXPECT_EQ(sent(registers).size(), 100u) << "it is full";
}

}  // namespace
}  // namespace iog::zcu102
