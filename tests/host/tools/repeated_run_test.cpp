// A target's run once more: of a car whose sensors' clocks are not those of the poses, so that its
// classes depend on when each packet came.
#include "tools/fuse/repeated_run.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <string>

#include "gtest/gtest.h"

#include "fakes/random.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/receive/run_statistics.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/drives/pose_source.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

constexpr std::uint32_t kFrames = 8;

struct UnsynchronisedCar {
  UnsynchronisedCar() {
    const vehicle::Vehicle& reference = *find_vehicle("reference_car").vehicle;
    sensors.assign(reference.sensors.begin(), reference.sensors.end());
    for (vehicle::Sensor& sensor : sensors) {
      sensor.is_synchronised = false;
    }
    vehicle = reference;
    vehicle.sensors = sensors;
  }
  std::vector<vehicle::Sensor> sensors;
  vehicle::Vehicle vehicle;
};

// Packets and poses in the order of their times.
std::vector<CapturedDatagram> some_drive() {
  Drive drive(find_vehicle("reference_car"), 1, 1, find_scene(kDefaultScene), Motion::kContinuous);
  PoseFeed feed(simulated_poses(drive.scene(), {}, 1, 1.2));
  std::vector<CapturedDatagram> all;
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    const auto packets = drive.datagrams(frame);
    const auto poses = feed.take_until(packets.back().time_us);
    all.insert(all.end(), poses.begin(), poses.end());
    all.insert(all.end(), packets.begin(), packets.end());
  }
  std::ranges::stable_sort(all, {}, &CapturedDatagram::time_us);
  return all;
}

// What a target made of it.
struct Run {
  RunStatistics statistics;
  std::vector<GridFrame> frames;
};

std::unique_ptr<Run> run_of(const vehicle::Vehicle& vehicle,
                            const std::function<void(OfflineTarget&)>& feed) {
  auto run = std::make_unique<Run>();
  FrameAssembler assembler([&](GridFrame&& frame) {
    run->statistics.add(frame);
    run->frames.push_back(std::move(frame));
  });
  const auto target = std::make_unique<OfflineTarget>(
      vehicle, [&](std::span<const std::byte> message) { assembler.take(message); });
  feed(*target);
  assembler.finish();
  return run;
}

// A target that takes each up to 30 ms after it came, and loses or leaves some.
std::unique_ptr<Run> late_run(const vehicle::Vehicle& vehicle,
                              const std::vector<CapturedDatagram>& drive) {
  return run_of(vehicle, [&](OfflineTarget& target) {
    tests::Random random(5);
    std::uint64_t now_us = 7'000'000;
    target.start(now_us);
    for (const CapturedDatagram& datagram : drive) {
      const std::uint64_t came_us = 8'000'000 + datagram.time_us - drive.front().time_us;
      now_us = std::max(now_us, came_us + random.below(30'000));
      if (random.below(20) == 0) {
        continue;
      }
      target.pass(now_us);
      target.take_at(datagram, now_us, random.below(20) == 0);
    }
    target.pass(now_us + 100'000);
  });
}

std::unique_ptr<Run> repeated(const vehicle::Vehicle& vehicle, const Run& run,
                              const std::vector<CapturedDatagram>& drive) {
  return run_of(vehicle, [&](OfflineTarget& target) {
    RepeatedRun again(vehicle);
    for (const GridFrame& frame : run.frames) {
      again.add(frame);
    }
    for (const CapturedDatagram& datagram : drive) {
      again.add(datagram);
    }
    again.play(target);
  });
}

std::string words_of_failure(const std::function<void()>& act) {
  try {
    act();
  } catch (const CheckFailed& failure) {
    return failure.what();
  }
  return "none";
}

TEST(RepeatedRun, HasTheGridsAndClassesOfTheFirst) {
  const UnsynchronisedCar car;
  const auto drive = some_drive();
  const auto first = late_run(car.vehicle, drive);
  ASSERT_GE(first->statistics.records().size(), kFrames);
  ASSERT_GT(first->statistics.classes().records().back().tiles, 100U);
  const auto on_time = run_of(car.vehicle, [&](OfflineTarget& target) {
    for (const CapturedDatagram& datagram : drive) {
      static_cast<void>(target.take(datagram));
    }
    target.finish();
  });
  ASSERT_NE(on_time->statistics.classes().run_hash(), first->statistics.classes().run_hash())
      << "arrival does not matter";
  const auto second = repeated(car.vehicle, *first, drive);
  EXPECT_EQ(second->statistics.run_hash(), first->statistics.run_hash());
  EXPECT_EQ(second->statistics.classes().run_hash(), first->statistics.classes().run_hash());
  EXPECT_EQ(second->statistics.objects().run_hash(), first->statistics.objects().run_hash());
}

TEST(RepeatedRun, NeedsEveryDatagramThatTheTargetTook) {
  const UnsynchronisedCar car;
  auto drive = some_drive();
  const auto first = late_run(car.vehicle, drive);
  drive.resize(drive.size() / 2);
  EXPECT_NE(words_of_failure([&] {
              static_cast<void>(repeated(car.vehicle, *first, drive));
            }).find("that the capture does not have"),
            std::string::npos);
}

TEST(RepeatedRun, IsOfAStreamThatSaysAllFromTheStart) {
  const UnsynchronisedCar car;
  const auto first = late_run(car.vehicle, some_drive());
  const auto told = [&](const std::function<void(std::vector<GridFrame>&)>& change) {
    std::vector<GridFrame> frames = first->frames;
    change(frames);
    return words_of_failure([&] {
      RepeatedRun run(car.vehicle);
      for (const GridFrame& frame : frames) {
        run.add(frame);
      }
    });
  };
  EXPECT_EQ(told([](auto& /*frames*/) {}), "none");
  EXPECT_NE(told([](auto& frames) { frames.erase(frames.begin() + 3); }).find("no message"),
            std::string::npos);
  EXPECT_NE(told([](auto& frames) {
              frames.erase(frames.begin(), frames.end() - 1);
            }).find("begins in the middle"),
            std::string::npos);
  EXPECT_NE(told([](auto& frames) { frames[2].receptions.reset(); }).find("is not whole"),
            std::string::npos);
  EXPECT_NE(told([](auto& frames) { frames[2].receptions->not_listed = 1; }).find("more than"),
            std::string::npos);
  EXPECT_NE(told([](auto& frames) { frames[2].header.run_number ^= 1; }).find("two runs"),
            std::string::npos);
  EXPECT_NE(told([](auto& frames) { frames[2].header.vehicle_id ^= 1; }).find("another car"),
            std::string::npos);
  EXPECT_NE(told([](auto& frames) { frames[0].header.flags &= 0x1F; }).find("does not say"),
            std::string::npos);
}

// docs/spec.md 3.13: nobody needs it where clocks are those of the poses, or without classes.
TEST(RepeatedRun, TakesNoByteOfOtherStreams) {
  const auto drive = some_drive();
  const auto synchronised = late_run(*find_vehicle("reference_car").vehicle, drive);
  EXPECT_FALSE(synchronised->frames.front().header.has_receptions());
  UnsynchronisedCar plain;
  plain.vehicle.grids = vehicle::Grids::kIndexes;
  const auto without = late_run(plain.vehicle, drive);
  EXPECT_FALSE(without->frames.front().header.has_receptions());
  const auto told = [](const vehicle::Vehicle& car, const auto& run) {
    return words_of_failure([&] { RepeatedRun(car).add(run.frames.front()); });
  };
  EXPECT_NE(told(plain.vehicle, *without).find("its car has no classes"), std::string::npos);
  EXPECT_NE(told(*find_vehicle("reference_car").vehicle, *synchronised).find("clocks of its car"),
            std::string::npos);
}

}  // namespace
}  // namespace iog::tools
