// What a map does to the perception grid: it names, and changes nothing else.
#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/reference_block.hpp"
#include "fakes/test_vehicles.hpp"
#include "perception_bench.hpp"
#include "stream/crc32.hpp"

namespace iog::app {
namespace {

using decision::Class;
using testing::kReplayer;
using testing::TimedDatagram;

// All that a tile remembers but its names and what the map says.
void add_state(const window::WindowView& view, std::size_t slot, stream::Crc32& crc) {
  const window::Tile& tile = view.tile(slot);
  for (std::size_t group = 0; group < window::kGroupsPerTile; ++group) {
    if (tile.is_known(group)) {
      crc.update(std::as_bytes(std::span(tile.free[group])));
      crc.update(std::as_bytes(std::span(&tile.taken[group], 1)));
    }
  }
  crc.update(std::as_bytes(std::span(tile.aged_at)));
  crc.update(std::as_bytes(std::span(tile.evidence_at)));
  crc.update(std::as_bytes(std::span(&tile.found, 1)));
  crc.update(std::as_bytes(std::span(&tile.ground, 1)));
}

// Of a frame; what is not placed has neither state nor classes.
struct Seen {
  std::uint32_t state = 0;  // a name of it
  std::vector<std::uint8_t> ages;
  std::vector<std::array<std::int8_t, geometry::kTileCells>> classes;
  map::LayerReport map;
  bool is_placed = false;
};

class StateList {
 public:
  void begin_frame(const stream::Header& /*header*/) {}
  void take_tile(std::size_t /*tile*/, tile_coding::TileCells /*cells*/) {}
  void end_frame() {}
  void take_classes(const stream::ClassEnd& end, const window::WindowView& view) {
    Seen& seen = frames.emplace_back();
    seen.map = end.map.layer;
    seen.is_placed = end.slice_count > 0;
    if (!seen.is_placed) {
      return;
    }
    stream::Crc32 crc;
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      if (view.is_known(slot)) {
        add_state(view, slot, crc);
        seen.ages.push_back(view.age_frames(slot));
        view.copy_classes(slot, seen.classes.emplace_back());
        look_at_names(view.tile(slot));
      }
    }
    seen.state = crc.value();
  }

  std::vector<Seen> frames;
  std::size_t wrong_names = 0;  // that are not those of the masses and what is ruled out now

 private:
  void look_at_names(const window::Tile& tile) {
    for (std::size_t group = 0; group < window::kGroupsPerTile; ++group) {
      if (tile.is_known(group)) {
        alignas(8) decision::Decided expected{};
        static_cast<void>(decision::decide(tile.free[group], tile.taken[group],
                                           tile.ruled_out[group], {}, expected));
        wrong_names += expected == tile.decided[group] ? 0U : 1U;
      }
    }
  }
};

using Bytes = std::vector<std::uint8_t>;

// The place of the local frame in the map's plane, by time; empty: it is not said.
using TransformAt = std::optional<pose::MapTransform> (*)(std::uint64_t frame);

constexpr std::int64_t kLatitude = 48'000'000'000;  // 1e-9 degrees
constexpr std::int64_t kLongitude = 2'000'000'000;  // 1e-9 degrees
constexpr pose::MapTransform kTransform{.origin = map::origin_name(kLatitude, kLongitude),
                                        .local_frame = {12'300, -45'600, 700'000'000},
                                        .sigma = {20, 40}};

std::optional<pose::MapTransform> steady(std::uint64_t /*frame*/) { return kTransform; }

// It moves by two centimetres a frame, by 3 m now and then, and is not said in some frames.
std::optional<pose::MapTransform> restless(std::uint64_t frame) {
  if (frame % 9 == 8) {
    return std::nullopt;
  }
  pose::MapTransform transform = kTransform;
  transform.local_frame.x_mm += static_cast<std::int32_t>(20 * frame + frame / 13 * 3'000);
  transform.sigma.position_mm = static_cast<std::uint16_t>(20 + frame % 5 * 40);
  return transform;
}

std::optional<pose::MapTransform> until_20(std::uint64_t frame) {
  return frame < 20 ? std::optional(kTransform) : std::nullopt;
}

// A point of the local frame in the plane of kTransform, in centimetres.
map::PointCm in_plane(double x_m, double y_m) {
  const double angle = kTransform.local_frame.heading * (2 * std::numbers::pi / 4294967296.0);
  return {static_cast<std::int32_t>(
              std::llround(kTransform.local_frame.x_mm / 10.0 +
                           100 * (std::cos(angle) * x_m - std::sin(angle) * y_m))),
          static_cast<std::int32_t>(
              std::llround(kTransform.local_frame.y_mm / 10.0 +
                           100 * (std::sin(angle) * x_m + std::cos(angle) * y_m)))};
}

tests::ReferenceRing box_of_local(double x_low, double y_low, double x_high, double y_high) {
  return {in_plane(x_low, y_low), in_plane(x_high, y_low), in_plane(x_high, y_high),
          in_plane(x_low, y_high)};
}

// The road that the car is on, and the house at its end; or, `is_wrong`, on it.
Bytes street(bool is_wrong = false) {
  return tests::ReferenceBlock{
      .latitude = kLatitude,
      .longitude = kLongitude,
      .extent = tests::box_around({0, 0}, 100'000),
      .accuracy_mm = 300,
      .features = {{map::Kind::kRoad, {box_of_local(-20, -4, 29, 4)}},
                   {map::Kind::kBuilding, {box_of_local(is_wrong ? 5 : 29.5, -30, 45, 30)}}}}
      .bytes();
}

constexpr int kFrames = tests::effort(50, 26);

// As many frames as it takes to look twice at all tiles, from the first time that they are drawn.
constexpr int kFramesOfAWrongMap = 64;

// Frames towards a wall, 30 m away. After each of them whoever sends pauses.
StateList drive(const Bytes* map, TransformAt transform, std::uint64_t pause_us = 0,
                int frames = kFrames) {
  const testing::Car car(tests::OneLux::kVehicle, true);
  tests::FakePlatform platform;
  StateList states;
  const auto pipeline = std::make_unique<PerceptionPipeline<tests::FakePlatform, StateList>>(
      car.vehicle(), kReplayer, platform, states);
  if (map != nullptr) {
    pipeline->begin_with_map(*map);
  }
  auto datagrams = testing::drive_at_wall(frames);
  std::ranges::stable_sort(datagrams, {}, &TimedDatagram::now_us);
  std::uint64_t paused_us = 0;
  for (TimedDatagram datagram : datagrams) {
    if (datagram.port == pose::kPosePort) {
      pose::Message message = pose::decode(datagram.bytes).message;
      message.map = transform((message.clock_us - testing::kStartUs) / testing::kPeriodUs);
      datagram = testing::datagram_of(message);
    }
    const std::size_t before = states.frames.size();
    pipeline->take({kReplayer, datagram.port, datagram.bytes}, datagram.now_us + paused_us);
    platform.frames.clear();  // nobody looks at them, and the target has no room for all
    if (pause_us > 0 && states.frames.size() > before) {
      paused_us += pause_us;
      while (pipeline->deadline_us() <= datagram.now_us + paused_us) {
        pipeline->tick(pipeline->deadline_us());
      }
    }
  }
  return states;
}

// Most tests compare the same drives, so each is made once.
const StateList& driven_without_map() {
  static const StateList states = drive(nullptr, steady);
  return states;
}
const StateList& driven_with_map(TransformAt transform) {
  static std::map<TransformAt, StateList> drives;
  if (!drives.contains(transform)) {
    const Bytes map = street();
    drives.emplace(transform, drive(&map, transform));
  }
  return drives.at(transform);
}

std::size_t count(const Seen& seen, Class what) {
  std::size_t cells = 0;
  for (const auto& tile : seen.classes) {
    cells += static_cast<std::size_t>(std::ranges::count_if(
        tile, [what](std::int8_t byte) { return static_cast<Class>(byte / 8) == what; }));
  }
  return cells;
}

TEST(PerceptionMap, WhatIsKnownIsTheSameWithAnyMap) {
  const StateList& without = driven_without_map();
  ASSERT_EQ(without.frames.size(), std::size_t{kFrames});
  for (const TransformAt transform : {&steady, &restless, &until_20}) {
    const StateList& with = driven_with_map(transform);
    ASSERT_EQ(with.frames.size(), without.frames.size());
    for (std::size_t frame = 0; frame < with.frames.size(); ++frame) {
      ASSERT_EQ(with.frames[frame].state, without.frames[frame].state) << frame;
      ASSERT_EQ(with.frames[frame].ages, without.frames[frame].ages) << frame;
    }
  }
}

// A target that is fed in lockstep makes frames of silence in between. What is drawn when, and so
// every name, is as without them.
TEST(PerceptionMap, APauseLeavesNoTrace) {
  const Bytes map = street();
  const StateList& without = driven_with_map(restless);
  StateList with = drive(&map, restless, 300'000);
  EXPECT_GT(with.frames.size(), 2 * without.frames.size());
  std::erase_if(with.frames, [](const Seen& seen) { return !seen.is_placed; });
  ASSERT_EQ(with.frames.size(), without.frames.size());
  std::size_t waited = 0;
  for (std::size_t frame = 0; frame < with.frames.size(); ++frame) {
    ASSERT_EQ(with.frames[frame].state, without.frames[frame].state) << frame;
    ASSERT_EQ(with.frames[frame].classes, without.frames[frame].classes) << frame;
    waited += with.frames[frame].map.tiles_waiting > 0 ? 1U : 0U;
  }
  EXPECT_GT(waited, 5U);
}

TEST(PerceptionMap, NamesAreAtOnceThoseOfTheMasksOfNow) {
  for (const TransformAt transform : {&steady, &restless, &until_20}) {
    const StateList& with = driven_with_map(transform);
    EXPECT_EQ(with.wrong_names, 0U);
  }
}

TEST(PerceptionMap, NamesWhatTheSensorsSee) {
  const StateList& with = driven_with_map(steady);
  const StateList& without = driven_without_map();
  const Seen& named = with.frames.back();
  const Seen& unnamed = without.frames.back();
  EXPECT_EQ(named.map.cause, map::Cause::kNone);
  EXPECT_EQ(unnamed.map.cause, map::Cause::kNoMap);
  EXPECT_GT(count(named, Class::kDrivable), 1000U);
  EXPECT_GT(count(named, Class::kNonDrivable), 1000U);
  EXPECT_GT(count(named, Class::kInfrastructure), 20U);
  const auto free = [](const Seen& seen) {
    return count(seen, Class::kFree) + count(seen, Class::kDrivable) +
           count(seen, Class::kNonDrivable);
  };
  EXPECT_EQ(free(named), free(unnamed)) << "the map never speaks alone";
  EXPECT_EQ(count(unnamed, Class::kDrivable) + count(unnamed, Class::kNonDrivable) +
                count(unnamed, Class::kInfrastructure),
            0U);
}

TEST(PerceptionMap, WithoutATransformClassesAreAtOnceAsWithoutAMap) {
  const StateList& with = driven_with_map(until_20);
  const StateList& without = driven_without_map();
  for (std::size_t frame = 0; frame < without.frames.size(); ++frame) {
    const bool is_lost = with.frames[frame].map.cause == map::Cause::kNoTransform;
    ASSERT_EQ(is_lost, frame >= 20) << frame;
    ASSERT_TRUE(!is_lost || with.frames[frame].classes == without.frames[frame].classes) << frame;
  }
  EXPECT_NE(with.frames[19].classes, without.frames[19].classes);
}

// From the frame on that says so, names are those that the sensors alone can tell.
TEST(PerceptionMap, AMapThatBeamsContradictNamesNothing) {
  const Bytes map = street(true);
  const StateList with = drive(&map, steady, 0, kFramesOfAWrongMap);
  const StateList without = drive(nullptr, steady, 0, kFramesOfAWrongMap);
  std::size_t contradicted = 0;
  for (std::size_t frame = 0; frame < without.frames.size(); ++frame) {
    const bool is_contradicted = with.frames[frame].map.cause == map::Cause::kContradicted;
    ASSERT_TRUE(is_contradicted || contradicted == 0) << frame;
    ASSERT_EQ(with.frames[frame].state, without.frames[frame].state) << frame;
    ASSERT_TRUE(!is_contradicted || with.frames[frame].classes == without.frames[frame].classes)
        << frame;
    contradicted += is_contradicted ? 1U : 0U;
  }
  EXPECT_GT(contradicted, 0U);
  EXPECT_EQ(with.frames.back().map.begun[8], 1U);
  EXPECT_EQ(driven_with_map(steady).frames.back().map.begun[8], 0U) << "the right map";
}

}  // namespace
}  // namespace iog::app
