// What one run leaves to the next.
#include "boot_record.hpp"

#include <cstring>
#include <gtest/gtest.h>
#include <string>

namespace iog::imx6 {
namespace {

TEST(BootRecord, ZeroedOrRandomMemoryIsAColdStart) {
  for (const int fill : {0x00, 0xff, 0x5a}) {
    BootRecord record{};
    std::memset(static_cast<void*>(&record), fill, sizeof(record));
    const Boot boot = open_boot_record(record);
    EXPECT_EQ(boot.reason, BootReason::kColdStart);
    EXPECT_EQ(boot.number, 1u);
    EXPECT_EQ(boot.last_word_text(), "");
  }
}

TEST(BootRecord, AResetWithoutALastWordIsToldApart) {
  BootRecord record{};
  open_boot_record(record);
  const Boot second = open_boot_record(record);
  EXPECT_EQ(second.reason, BootReason::kWithoutAWord);
  EXPECT_EQ(second.number, 2u);
}

TEST(BootRecord, ALastWordIsReportedOnce) {
  BootRecord record{};
  open_boot_record(record);
  write_last_word(record, "data abort");
  const Boot second = open_boot_record(record);
  EXPECT_EQ(second.reason, BootReason::kAfterLastWord);
  EXPECT_EQ(second.last_word_text(), "data abort");
  const Boot third = open_boot_record(record);
  EXPECT_EQ(third.reason, BootReason::kWithoutAWord);
  EXPECT_EQ(third.number, 3u);
  EXPECT_EQ(third.last_word_text(), "");
}

TEST(BootRecord, ALongLastWordIsCut) {
  BootRecord record{};
  open_boot_record(record);
  write_last_word(record, std::string(1000, 'x'));
  EXPECT_EQ(open_boot_record(record).last_word_text(), std::string(240, 'x'));
}

TEST(BootRecord, AnyBitThatFlipsMakesItACuriosityNotARecord) {
  BootRecord sealed{};
  open_boot_record(sealed);
  write_last_word(sealed, "ab");
  constexpr std::size_t kUsed = offsetof(BootRecord, last_word) + 2;
  for (std::size_t bit = 0; bit < 8 * kUsed; ++bit) {
    BootRecord record = sealed;
    reinterpret_cast<unsigned char*>(&record)[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
    EXPECT_EQ(open_boot_record(record).reason, BootReason::kColdStart) << "bit " << bit;
  }
}

}  // namespace
}  // namespace iog::imx6
