// What the loop says of its own times: rows of worst, sum and histogram, in docs/spec.md's order.
#include "app/loop_times.hpp"

#include <gtest/gtest.h>

#include "fake_machine.hpp"

namespace iog::app {
namespace {

constexpr std::uint32_t kHz = 2'000'000;  // two ticks a microsecond
// docs/spec.md 3.7.

struct Row {
  std::uint32_t worst_us = 0;
  std::uint64_t sum_us = 0;
  std::uint64_t count = 0;
  friend bool operator==(const Row&, const Row&) = default;
};

std::ostream& operator<<(std::ostream& out, const Row& row) {
  return out << row.worst_us << ", " << row.sum_us << ", " << row.count;
}

Row row(const LoopTimes& times, std::size_t number) {
  const health::Durations& its = times.counts().rows.at(number);
  return {.worst_us = its.worst_us, .sum_us = its.sum_us(), .count = its.count()};
}

// fuse, mark, publish of the frame before, perceive; the frame; how late; then the cores.
TEST(LoopTimes, PublishingIsKnownAfterTheFrame) {
  LoopTimes times;
  const work::CoreTimes cores;
  times.add({.ticks = {.fuse = 2'000, .mark = 400, .publish = 0, .perceive = 6'000},
             .late_us = 70,
             .has_packets = true},
            cores, kHz);
  EXPECT_EQ(row(times, 0), (Row{1'000, 1'000, 1}));
  EXPECT_EQ(row(times, 1), (Row{200, 200, 1}));
  EXPECT_EQ(row(times, 2), (Row{0, 0, 0}));
  EXPECT_EQ(row(times, 3), (Row{3'000, 3'000, 1}));
  EXPECT_EQ(row(times, 4), (Row{0, 0, 0}));
  EXPECT_EQ(row(times, 5), (Row{70, 70, 1}));
  // The next one is silent: it says what publishing took, and nothing of itself.
  times.add({.ticks = {.fuse = 2, .mark = 4, .publish = 1'000, .perceive = 8}}, cores, kHz);
  times.add({.ticks = {.publish = 99'000}}, cores, kHz);
  EXPECT_EQ(row(times, 2), (Row{500, 500, 1}));
  EXPECT_EQ(row(times, 4), (Row{4'700, 4'700, 1}));
  EXPECT_EQ(row(times, 0), (Row{1'000, 1'000, 1}));
}

// Also over the end of what its counter holds.
TEST(LoopTimes, ACoreCountsInFramesForWhichItHasWorked) {
  LoopTimes times;
  work::CoreTimes cores;
  cores.add(2, 0xFFFFFF00U);
  times.add({}, cores, kHz);
  cores.add(2, 0x300);
  times.add({}, cores, kHz);
  times.add({}, cores, kHz);
  EXPECT_EQ(row(times, 8), (Row{0x7FFFFF80U, 0x7FFFFF80ULL + 0x180, 2}));
  EXPECT_EQ(row(times, 6), (Row{0, 0, 0}));
}

TEST(LoopTimes, WithoutARateNothingTookTime) {
  LoopTimes times;
  times.add({.ticks = {.fuse = 2'000}, .has_packets = true}, work::CoreTimes{}, 0);
  EXPECT_EQ(row(times, 0), (Row{0, 0, 1}));
}

TEST(LoopTimes, TellsWhatHasBecomeWorseOnceASecond) {
  LoopTimes times;
  testing::FakeConsole console;
  times.add({.ticks = {.fuse = 2'000}, .late_us = 1'234'567, .has_packets = true},
            work::CoreTimes{}, kHz);
  for (std::uint64_t ms = 0; ms < 5'000; ++ms) {
    times.tell(ms * 1'000, console);
  }
  EXPECT_EQ(console.text, "worst fuse 1000 us\nworst late 1234567 us\n");
}

}  // namespace
}  // namespace iog::app
