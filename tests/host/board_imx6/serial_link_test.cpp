// UART1 against the i.MX6DQ manual, and against a transmitter with a FIFO of 32 bytes.
#include "serial_link.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "hal/serial_port.hpp"
#include "trace.hpp"

namespace iog::imx6 {
namespace {

using machine::poke;
using machine::recorder;
using machine::Write;

static_assert(hal::SerialPort<SerialLink>);

class Line : public testing::Test {
 protected:
  Line() { recorder.reset(); }

  void set_ready(bool is_ready) {
    poke(registers_.usr1, is_ready ? UartRegisters::kUsr1TransmitReady : 0u);
  }

  std::vector<std::byte> sent() const {
    std::vector<std::byte> bytes;
    for (const Write& write : machine::writes_to(registers_)) {
      if (write.offset == 0x40) {  // UTXD
        bytes.push_back(static_cast<std::byte>(write.value));
      }
    }
    return bytes;
  }

  // The manual's FIFO: 32 places; TRDY while fewer than 16 are taken.
  void give_it_a_fifo() {
    recorder.on_store = [this](const void* address, std::uint32_t) {
      if (address == &registers_.utxd) {
        EXPECT_LT(fifo_, 32u) << "a byte is lost";
        ++fifo_;
      }
      set_ready(fifo_ < 16);
    };
    set_ready(true);
  }
  void shift_out() {
    fifo_ -= fifo_ > 0 ? 1u : 0u;
    set_ready(fifo_ < 16);
  }

  static std::vector<std::byte> bytes(std::size_t count) {
    std::vector<std::byte> bytes(count);
    for (std::size_t i = 0; i < count; ++i) {
      bytes[i] = static_cast<std::byte>(i * 7 + i / 256);
    }
    return bytes;
  }

  UartRegisters registers_{};
  SerialLink link_{registers_};
  unsigned fifo_ = 0;
};

TEST_F(Line, StartsLikeTheConsoleButAsksForMoreBytesEarlier) {
  recorder.on_store = [this](const void* address, std::uint32_t value) {
    if (address == &registers_.ucr2 && value == 0) {
      poke(registers_.ucr2, 1u);  // the software reset ends by itself
    }
  };
  link_.start();
  const std::vector<Write> expected = {
      {0x80, 0x0000},  // UCR1: off
      {0x84, 0x0000},  // UCR2: software reset
      {0x84, 0x4027},  // UCR2: IRTS, WS, TXEN, RXEN, SRST
      {0x88, 0x0004},  // UCR3: RXDMUXSEL
      {0x8c, 0x8000},  // UCR4: CTSTL = 32
      {0x90, 0x4281},  // UFCR: TXTL = 16, RFDIV = 1, RXTL = 1
      {0xa4, 71},      // UBIR before
      {0xa8, 3124},    // UBMR
      {0x80, 0x0001},  // UCR1: UARTEN
  };
  EXPECT_EQ(machine::writes_to(registers_), expected);
}

TEST_F(Line, CarriesATenthOfItsBaudInBytes) { EXPECT_EQ(link_.bytes_per_second(), 11'520u); }

TEST_F(Line, WaitsForTheTransmitterWithoutBlocking) {
  set_ready(false);
  link_.write(bytes(100));
  link_.pump();
  EXPECT_TRUE(sent().empty());
  EXPECT_EQ(link_.free_bytes(), SerialLink::kRingBytes - 100);
}

TEST_F(Line, AReadyTransmitterGetsNoMoreThanSurelyFits) {
  set_ready(true);
  link_.write(bytes(100));
  EXPECT_EQ(sent().size(), 16u);
}

TEST_F(Line, KeepsOrderAndLosesNothingAcrossTheEndOfTheRing) {
  give_it_a_fifo();
  const std::vector<std::byte> all = bytes(3 * SerialLink::kRingBytes + 17);
  std::span<const std::byte> left = all;
  while (!left.empty()) {
    const std::size_t now = std::min({left.size(), link_.free_bytes(), std::size_t{1000}});
    link_.write(left.first(now));
    left = left.subspan(now);
    for (int characters = 0; characters < 500; ++characters) {
      shift_out();
      link_.pump();
    }
  }
  while (link_.free_bytes() < SerialLink::kRingBytes) {
    shift_out();
    link_.pump();
  }
  EXPECT_EQ(sent(), all);
}

// 2.8 ms of the FIFO less the 16 bytes at which it asks for more are 1.4 ms: the loop comes every
// millisecond, 11.5 characters.
TEST_F(Line, NeverRunsDryInALoopThatComesEveryMillisecond) {
  give_it_a_fifo();
  link_.write(bytes(SerialLink::kRingBytes));
  link_.pump();
  for (int milliseconds = 0; milliseconds < 300; ++milliseconds) {
    for (int characters = 0; characters < 12; ++characters) {
      ASSERT_GT(fifo_, 0u);
      shift_out();
    }
    link_.pump();
  }
}

// UCR1.TRDYEN, bit 13.
TEST_F(Line, WakesTheCoreOnlyWhileSomethingWaits) {
  set_ready(false);
  link_.pump();
  EXPECT_TRUE(machine::writes_to(registers_).empty());
  link_.write(bytes(20));
  EXPECT_EQ(machine::last_write(registers_, 0x80), 0x2001u);
  set_ready(true);
  link_.pump();
  EXPECT_EQ(machine::last_write(registers_, 0x80), 0x2001u);
  link_.pump();
  EXPECT_EQ(machine::last_write(registers_, 0x80), 0x0001u);
  EXPECT_EQ(sent(), bytes(20));
}

}  // namespace
}  // namespace iog::imx6
