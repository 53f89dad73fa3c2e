// Which clouds are sent, by their stamps: half a minute of a lidar at 10 Hz.
#include "tools/clouds/cloud_order.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "cloud_bytes.hpp"

namespace iog::tools {
namespace {

using Times = std::vector<std::uint64_t>;

constexpr std::uint64_t kStartUs = 1'700'000'000'000'000;
constexpr std::uint64_t kPeriodUs = 100'000;
constexpr std::uint64_t kHourUs = 3'600'000'000;
constexpr std::size_t kClouds = 40;

Times even_times() {
  Times times;
  for (std::size_t i = 0; i < kClouds; ++i) {
    times.push_back(kStartUs + i * kPeriodUs);
  }
  return times;
}

Times without(Times times, std::size_t number) {
  times.erase(times.begin() + static_cast<std::ptrdiff_t>(number));
  return times;
}

Times taken(CloudOrder& order, const Times& times) {
  Times in_order;
  const auto add = [&](const std::vector<SeenCloud>& clouds) {
    std::ranges::transform(clouds, std::back_inserter(in_order), &SeenCloud::time_us);
  };
  for (const std::uint64_t time_us : times) {
    add(order.take({.time_us = time_us}));
  }
  add(order.finish());
  return in_order;
}

std::string told(const Times& times) {
  CloudOrder order;
  return told_by([&] { static_cast<void>(taken(order, times)); });
}

TEST(CloudOrder, RisingStampsAreInOrder) {
  CloudOrder order;
  EXPECT_EQ(taken(order, even_times()), even_times());
  EXPECT_EQ(order.out_of_order() + order.strays(), 0U);
}

TEST(CloudOrder, EqualStampsAreInOrder) {
  CloudOrder order;
  EXPECT_EQ(taken(order, Times(kClouds, 0)), Times(kClouds, 0));
}

TEST(CloudOrder, OneWrongStampCostsItsOwnCloud) {
  for (std::size_t number = 0; number + 1 < kClouds; ++number) {
    for (const bool is_ahead : {true, false}) {
      if (number <= 1 && !is_ahead) {
        continue;  // looks like a pause after it, or as if the first one were ahead
      }
      CloudOrder order;
      Times times = even_times();
      times[number] = is_ahead ? times[number] + kHourUs : times[number] - kHourUs;
      EXPECT_EQ(taken(order, times), without(even_times(), number)) << number << is_ahead;
      EXPECT_EQ(order.strays(), 1U);
      EXPECT_EQ(order.out_of_order(), 0U);
    }
  }
}

// A stamp of 0 is one that a driver did not set.
TEST(CloudOrder, OneMissingStampCostsItsOwnCloud) {
  CloudOrder order;
  Times times = even_times();
  times[20] = 0;
  EXPECT_EQ(taken(order, times), without(even_times(), 20));
}

TEST(CloudOrder, SeveralWrongStampsAreCounted) {
  CloudOrder order;
  Times times = even_times();
  times[0] += kHourUs;
  times[20] -= kHourUs;
  times[22] += kHourUs;
  times[39] -= kHourUs;
  Times expected = even_times();
  for (const std::size_t number : {39U, 22U, 20U, 0U}) {
    expected = without(expected, number);
  }
  EXPECT_EQ(taken(order, times), expected);
  EXPECT_EQ(order.strays(), 4U);
}

TEST(CloudOrder, PausesAndSlowUnitsAreInOrder) {
  Times times = even_times();
  for (std::size_t i = 20; i < kClouds; ++i) {
    times[i] += kHourUs;
  }
  times.push_back(times.back() + kHourUs);  // the last one, too
  CloudOrder order;
  EXPECT_EQ(taken(order, times), times);
  const Times slow{0, 10'000'000, 20'000'000, 30'000'000};
  CloudOrder other;
  EXPECT_EQ(taken(other, slow), slow);
  EXPECT_EQ(order.strays() + other.strays(), 0U);
}

// As between two threads of a driver.
TEST(CloudOrder, ASmallStepBackIsSkipped) {
  CloudOrder order;
  Times times = even_times();
  times[25] = times[15];
  EXPECT_EQ(taken(order, times), without(even_times(), 25));
  EXPECT_EQ(order.out_of_order(), 1U);
  EXPECT_EQ(order.furthest_back_us(), 900'000U);
}

TEST(CloudOrder, AClockThatIsSetBackEndsIt) {
  Times times = even_times();
  for (std::size_t i = 20; i < kClouds; ++i) {
    times[i] -= kHourUs;
  }
  const std::string words =
      "from cloud 20 on, time goes back from 1700000001.900000 s to 1699996402.000000 s: give "
      "files "
      "in order of time, and split a recording where its clock was set back";
  EXPECT_EQ(told(times), words);
  times.resize(22);
  EXPECT_EQ(told(times), words) << "with the second cloud";
  times.resize(21);
  EXPECT_EQ(told(times), "");
}

TEST(CloudOrder, WrongStampsInARowEndIt) {
  Times times = even_times();
  times[20] += kHourUs;
  times[21] += kHourUs;
  EXPECT_TRUE(told(times).starts_with(
      "from cloud 22 on, time goes back from 1700003602.100000 s to 1700000002.200000 s: "))
      << told(times);
  times[20] += kHourUs;  // two stamps, which are far from each other
  EXPECT_TRUE(told(times).starts_with(
      "from cloud 22 on, time goes back from 1700003602.100000 s to 1700000002.200000 s: "))
      << told(times);
  EXPECT_TRUE(
      told({4 * kHourUs, 3 * kHourUs, 2 * kHourUs})
          .starts_with("from cloud 2 on, time goes back from 10800.000000 s to 7200.000000 s"));
}

}  // namespace
}  // namespace iog::tools
