// The guards between grids and planes, which the firmware asks in the background (docs/safety.md).
#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <memory>
#include <span>
#include <vector>

#include "fakes/test_vehicles.hpp"
#include "health/guard.hpp"
#include "health/memory_check.hpp"
#include "perception_bench.hpp"

namespace iog::app {
namespace {

using testing::kReplayer;
using testing::TimedDatagram;

template <typename Pipeline>
std::vector<health::Guard*> guards_of(Pipeline& pipeline) {
  std::vector<health::Guard*> guards;
  pipeline.for_each_guard([&guards](health::Guard& guard) { guards.push_back(&guard); });
  return guards;
}

// The first is where the pipeline begins. Behind the last there is no more than a few counters, and
// between two there is something that they guard.
template <typename Pipeline>
void expect_around(Pipeline& pipeline) {
  const std::vector<health::Guard*> guards = guards_of(pipeline);
  const auto* const begin = reinterpret_cast<const std::byte*>(&pipeline);
  std::vector<std::ptrdiff_t> at;
  std::ranges::transform(guards, std::back_inserter(at), [begin](const health::Guard* guard) {
    return guard->bytes().data() - begin;
  });
  ASSERT_GE(at.size(), 2U);
  EXPECT_EQ(at.front(), 0);
  EXPECT_GT(at.back(), static_cast<std::ptrdiff_t>(sizeof(Pipeline)) - 1024);
  for (std::size_t i = 1; i < at.size(); ++i) {
    EXPECT_GT(at[i] - at[i - 1], static_cast<std::ptrdiff_t>(sizeof(health::Guard))) << i;
  }
}

// Frames of a whole drive, all of whose guards are what they were set to.
template <typename Pipeline>
void expect_unwritten(Pipeline& pipeline) {
  const std::vector<health::Guard*> guards = guards_of(pipeline);
  std::ranges::for_each(guards, &health::Guard::set);
  std::vector<TimedDatagram> drive = testing::drive_at_wall(5);
  std::ranges::stable_sort(drive, {}, &TimedDatagram::now_us);
  for (const TimedDatagram& datagram : drive) {
    pipeline.take({kReplayer, datagram.port, datagram.bytes}, datagram.now_us);
  }
  for (std::size_t i = 0; i < guards.size(); ++i) {
    EXPECT_TRUE(std::ranges::all_of(guards[i]->words, [](std::uint32_t word) {
      return word == health::Guard::kWord;
    })) << i;
  }
}

// What the start has set stays as it is, and the vehicle is among it wherever somebody points to
// it.
template <typename Pipeline>
void expect_settings(Pipeline& pipeline, const vehicle::Vehicle& car, std::size_t pointers) {
  std::vector<health::Region> regions;
  std::size_t found = 0;
  pipeline.for_each_constant([&](std::span<const std::byte> bytes) {
    regions.push_back({.name = "", .bytes = bytes, .crc = health::crc_of(bytes)});
    const vehicle::Vehicle* const vehicle = &car;
    found += std::ranges::equal(bytes, std::as_bytes(std::span(&vehicle, 1))) ? 1U : 0U;
  });
  EXPECT_EQ(found, pointers);
  expect_unwritten(pipeline);
  EXPECT_FALSE(health::MemoryCheck(regions).look_at_all());
}

TEST(Settings, StayAsTheStartHasSetThem) {
  tests::FakePlatform platform;
  const auto pipeline =
      std::make_unique<Pipeline<tests::FakePlatform>>(tests::OneLux::kVehicle, kReplayer, platform);
  expect_settings(*pipeline, tests::OneLux::kVehicle, 3);  // frame, fusion, ground
  const testing::Car car(tests::OneLux::kVehicle, true);
  testing::PerceptionBench bench(car.vehicle());
  expect_settings(*bench.pipeline, car.vehicle(), 4);  // and the engine
}

TEST(Guards, StandAroundTheGridsAndAreNotWritten) {
  tests::FakePlatform platform;
  const auto pipeline =
      std::make_unique<Pipeline<tests::FakePlatform>>(tests::OneLux::kVehicle, kReplayer, platform);
  expect_around(*pipeline);
  expect_unwritten(*pipeline);
  EXPECT_GE(platform.frames.size(), 4U);
}

// Of a helper's fusion, and behind the places of parts.
TEST(Guards, StandBehindWhatHelpersWrite) {
  const auto helpers = std::make_unique<fusion::HelpersMemory<2>>(tests::OneLux::kVehicle);
  const fusion::HelpersSpace space = helpers->space();
  const std::vector<health::Guard*> guards = guards_of(*helpers);
  ASSERT_EQ(guards.size(), 2U);
  const auto end_of = [](const auto& last) {
    return std::as_bytes(std::span(&last, 1)).data() + sizeof(last);
  };
  EXPECT_LE(guards[0]->bytes().data() + sizeof(health::Guard), end_of(space.fusions.back()));
  EXPECT_GT(guards[0]->bytes().data(), end_of(space.fusions.back().lows(0)));
  EXPECT_GE(guards[1]->bytes().data(), end_of(space.parts.back()));
}

TEST(Guards, StandAroundThePlanesAndAreNotWritten) {
  const testing::Car car(tests::OneLux::kVehicle, true);
  testing::PerceptionBench bench(car.vehicle());
  expect_around(*bench.pipeline);
  expect_unwritten(*bench.pipeline);
  EXPECT_GE(bench.classes.reports.size(), 4U);
  EXPECT_FALSE(bench.classes.cells.empty());
}

}  // namespace
}  // namespace iog::app
