// What one run leaves to the next.
#include "boot_record.hpp"

#include <bit>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <set>
#include <string>

#include "memory/l2_cache.hpp"
#include "trace.hpp"

namespace iog::imx6 {
namespace {

Pl310Registers pl310_in_ram{};
L2Cache l2_cache(pl310_in_ram);

using hal::EndCause;
constexpr hal::End kEnd{.cause = EndCause::kException, .detail = 4};

TEST(BootRecord, ZeroedOrRandomMemoryIsAColdStart) {
  for (const int fill : {0x00, 0xff, 0x5a}) {
    BootRecord record{};
    std::memset(static_cast<void*>(&record), fill, sizeof(record));
    const Boot boot = open_boot_record(record, l2_cache);
    EXPECT_EQ(boot.before.end.cause, EndCause::kPowerUp);
    EXPECT_EQ(boot.before.starts, 1u);
    EXPECT_EQ(boot.last_word_text(), "");
  }
}

TEST(BootRecord, AResetWithoutALastWordIsToldApart) {
  BootRecord record{};
  open_boot_record(record, l2_cache);
  const Boot second = open_boot_record(record, l2_cache);
  EXPECT_EQ(second.before.end.cause, EndCause::kWithoutAWord);
  EXPECT_EQ(second.before.starts, 2u);
}

TEST(BootRecord, ALastWordIsReportedOnce) {
  BootRecord record{};
  open_boot_record(record, l2_cache);
  write_last_word(record, kEnd, "data abort", l2_cache);
  const Boot second = open_boot_record(record, l2_cache);
  EXPECT_EQ(second.before.end.cause, EndCause::kException);
  EXPECT_EQ(second.before.end.detail, 4u);
  EXPECT_EQ(second.last_word_text(), "data abort");
  const Boot third = open_boot_record(record, l2_cache);
  EXPECT_EQ(third.before.end.cause, EndCause::kWithoutAWord);
  EXPECT_EQ(third.before.end.detail, 0u);
  EXPECT_EQ(third.before.starts, 3u);
  EXPECT_EQ(third.last_word_text(), "");
}

// ARM's errata notice of the PL310, 769419: what is stored to uncached memory may stay in its store
// buffer for good, until a cache sync (ARM DDI 0246, offset 0x730) drains it.
template <typename Change>
void expect_drained_after(Change&& change) {
  using Kind = machine::Event::Kind;
  machine::recorder.reset();
  change();
  ASSERT_EQ(machine::recorder.events.size(), 3U);
  EXPECT_EQ(machine::recorder.events[0].kind, Kind::kBarrier);
  EXPECT_EQ(machine::writes_to(pl310_in_ram), (std::vector<machine::Write>{{0x730, 0}}));
  EXPECT_EQ(machine::recorder.events[2].kind, Kind::kBarrier);
}

TEST(BootRecord, IsInMemoryAfterEachChange) {
  BootRecord record{};
  expect_drained_after([&record] { open_boot_record(record, l2_cache); });
  expect_drained_after([&record] { begin_run(record, {.ticks = 5}, l2_cache); });
  expect_drained_after([&record] { write_last_word(record, kEnd, "data abort", l2_cache); });
}

TEST(RunNumber, AResetAddsOne) {
  BootRecord record{};
  open_boot_record(record, l2_cache);
  const std::uint32_t first = begin_run(record, {.ticks = 5}, l2_cache);
  for (std::uint32_t reset = 1; reset <= 3; ++reset) {
    EXPECT_EQ(open_boot_record(record, l2_cache).before.starts, reset + 1);
    EXPECT_EQ(begin_run(record, {.ticks = 77 * reset}, l2_cache), first + reset)
        << "whatever differs";
  }
}

TEST(RunNumber, ALastWordAndABootThatEndsBeforeItsRunKeepIt) {
  BootRecord record{};
  open_boot_record(record, l2_cache);
  const std::uint32_t first = begin_run(record, {.ticks = 5}, l2_cache);
  write_last_word(record, kEnd, "watch out", l2_cache);
  open_boot_record(record, l2_cache);
  open_boot_record(record, l2_cache);
  EXPECT_EQ(begin_run(record, {}, l2_cache), first + 1);
}

// A cold start that ends in a fault before its run has begun leaves a sound record without a
// number.
TEST(RunNumber, IsDrawnWhenTheColdStartDidNotGetThatFar) {
  BootRecord record{};
  std::memset(static_cast<void*>(&record), 0x5a, sizeof(record));
  open_boot_record(record, l2_cache);
  write_last_word(record, kEnd, "data abort", l2_cache);
  ASSERT_EQ(open_boot_record(record, l2_cache).before.end.cause, EndCause::kException);
  BootRecord fresh{};
  open_boot_record(fresh, l2_cache);
  EXPECT_EQ(begin_run(record, {.ticks = 9}, l2_cache), begin_run(fresh, {.ticks = 9}, l2_cache));
}

TEST(RunNumber, IsNeverZero) {
  BootRecord record{};
  open_boot_record(record, l2_cache);
  begin_run(record, {}, l2_cache);
  record.run_number = 0xFFFFFFFE;
  EXPECT_EQ(begin_run(record, {}, l2_cache), 0xFFFFFFFF);
  EXPECT_EQ(begin_run(record, {}, l2_cache), 1u);
  BootRecord cold{};
  open_boot_record(cold, l2_cache);
  EXPECT_NE(begin_run(cold, {}, l2_cache), 0u) << "nothing differs from nothing";
}

std::uint32_t number_after_cold_start(const Differences& differences) {
  BootRecord record{};
  std::memset(static_cast<void*>(&record), 0xa5, sizeof(record));
  open_boot_record(record, l2_cache);
  return begin_run(record, differences, l2_cache);
}

// One cell of DDR, one tick, one bit of the address: half of the number's bits are others. Of some
// 8000 single bits each, the mean must be within 16 +- 0.2, that is six deviations of 2.83 / sqrt
// n.
TEST(RunNumber, EveryBitThatDiffersChangesAllOfIt) {
  std::array<std::uint32_t, 256> noise{};
  Differences differences{.noise = noise, .ticks = 0x1234'5678, .mac = {2, 0x69, 0x6f, 0x67, 0, 1}};
  const std::uint32_t before = number_after_cold_start(differences);
  int changed = 0;
  int cases = 0;
  const auto look = [&] {
    const std::uint32_t number = number_after_cold_start(differences);
    EXPECT_NE(number, before);
    changed += std::popcount(number ^ before);
    ++cases;
  };
  for (std::uint32_t& word : noise) {
    for (unsigned bit = 0; bit < 32; ++bit) {
      word ^= 1u << bit;
      look();
      word ^= 1u << bit;
    }
  }
  EXPECT_NEAR(static_cast<double>(changed) / cases, 16.0, 0.2);
  for (unsigned bit = 0; bit < 32; ++bit) {
    differences.ticks ^= 1u << bit;
    look();
    differences.ticks ^= 1u << bit;
  }
  for (std::uint8_t& octet : differences.mac) {
    octet ^= 1u;
    look();
    octet ^= 1u;
  }
}

// As many power-ups as a car has in its life; of 20,000 numbers drawn from 2^32, 0.05 pairs are
// alike on the mean.
TEST(RunNumber, TicksAloneTellPowerUpsApart) {
  std::set<std::uint32_t> numbers;
  for (std::uint32_t ticks = 1'500'000; ticks < 1'520'000; ++ticks) {
    numbers.insert(number_after_cold_start({.ticks = ticks}));
  }
  EXPECT_EQ(numbers.size(), 20'000u) << "each step maps one to one";
}

TEST(BootRecord, ALongLastWordIsCut) {
  BootRecord record{};
  open_boot_record(record, l2_cache);
  write_last_word(record, kEnd, std::string(1000, 'x'), l2_cache);
  EXPECT_EQ(open_boot_record(record, l2_cache).last_word_text(), std::string(240, 'x'));
}

TEST(BootRecord, AnyBitThatFlipsMakesItACuriosityNotARecord) {
  BootRecord sealed{};
  open_boot_record(sealed, l2_cache);
  write_last_word(sealed, kEnd, "ab", l2_cache);
  constexpr std::size_t kUsed = offsetof(BootRecord, last_word) + 2;
  for (std::size_t bit = 0; bit < 8 * kUsed; ++bit) {
    BootRecord record = sealed;
    reinterpret_cast<unsigned char*>(&record)[bit / 8] ^= static_cast<unsigned char>(1u << bit % 8);
    EXPECT_EQ(open_boot_record(record, l2_cache).before.end.cause, EndCause::kPowerUp)
        << "bit " << bit;
  }
}

TEST(BootRecord, ALastWordThatIsTooLongIsCut) {
  BootRecord record{};
  const std::string text(BootRecord::kLastWordBytes + 1, 'x');
  write_last_word(record, kEnd, text, l2_cache);
  const Boot boot = open_boot_record(record, l2_cache);
  EXPECT_EQ(boot.last_word_bytes, BootRecord::kLastWordBytes);
  EXPECT_EQ(boot.before.end.cause, kEnd.cause);
}

// A bit of DDR that has flipped while the firmware ran: nothing behind the record is read.
TEST(BootRecord, ALengthThatCannotBeIsNotFollowed) {
  const auto record = std::make_unique<BootRecord>();
  record->last_word_bytes = 0x8000'0000;
  static_cast<void>(begin_run(*record, {}, l2_cache));
  EXPECT_EQ(open_boot_record(*record, l2_cache).before.starts, Boot{}.before.starts);
}

}  // namespace
}  // namespace iog::imx6
