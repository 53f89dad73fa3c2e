// What of a frame's datagrams its list has (docs/spec.md 3.13).
#include "app/reception_log.hpp"

#include <gtest/gtest.h>

namespace iog::app {
namespace {

constexpr std::uint16_t kPort = 12349;
constexpr intake::Datagram kDatagram{.destination_port = kPort, .payload = {}};

// 1,300 have room; how many came behind them is said, frame by frame.
TEST(ReceptionLog, CountsThoseForWhichItHasNoRoom) {
  ReceptionLog log(true);
  for (std::uint64_t i = 0; i < 1'303; ++i) {
    log.add(kDatagram, 5'000 + i);
  }
  log.note_left();  // of one that is not in the list
  log.close(10'000);
  ASSERT_EQ(log.all().size(), 1'300U);
  EXPECT_EQ(log.not_listed(), 3U);
  EXPECT_EQ(log.all().back().port, kPort);
  EXPECT_EQ(log.all().back().before_close_us, 10'000U - 5'000 - 1'299);
  EXPECT_FALSE(log.all().back().was_left);
  log.clear();
  EXPECT_TRUE(log.all().empty());
  EXPECT_EQ(log.not_listed(), 0U);
}

// Times are modulo 2^32 us until the frame is closed.
TEST(ReceptionLog, TellsHowLongBeforeTheEndAlsoOverTwoToThe32) {
  constexpr std::uint64_t kWrap = std::uint64_t{1} << 32;
  ReceptionLog log(true);
  log.add(kDatagram, kWrap - 700);
  log.add(kDatagram, kWrap + 200);
  log.note_left();
  log.close(kWrap + 300);
  ASSERT_EQ(log.all().size(), 2U);
  EXPECT_EQ(log.all()[0].before_close_us, 1'000U);
  EXPECT_FALSE(log.all()[0].was_left);
  EXPECT_EQ(log.all()[1].before_close_us, 100U);
  EXPECT_TRUE(log.all()[1].was_left);
}

TEST(ReceptionLog, HoldsNothingIfItIsOff) {
  ReceptionLog log(false);
  log.add(kDatagram, 5'000);
  log.note_left();
  EXPECT_TRUE(log.all().empty());
  EXPECT_EQ(log.not_listed(), 0U);
}

}  // namespace
}  // namespace iog::app
