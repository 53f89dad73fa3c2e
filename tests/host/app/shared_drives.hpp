// Drives that one core plays, and several: what comes of them has to be the same.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "app/pipeline.hpp"
#include "fakes/ground_car.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "fakes/velodyne_packet.hpp"
#include "perception_drive.hpp"
#include "sharing_platform.hpp"

namespace iog::app::testing {

using Drive = std::vector<TimedDatagram>;

struct Played {
  std::vector<SharingPlatform::Message> messages;
  std::vector<std::byte> beside;  // of the window, or names of grids
  friend bool operator==(const Played&, const Played&) = default;
};

template <typename T>
void append(const T& value, std::vector<std::byte>& bytes) {
  const auto all = std::as_bytes(std::span(&value, 1));
  bytes.insert(bytes.end(), all.begin(), all.end());
}

// All that the window holds after a frame, as far as it means something.
class Masses {
 public:
  void begin_frame(const stream::Header& /*header*/) {}
  void take_tile(std::size_t /*tile*/, tile_coding::TileCells /*cells*/) {}
  void end_frame() {}
  void take_classes(const stream::ClassEnd& /*end*/, const window::WindowView& classes) {
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      if (classes.is_known(slot)) {
        keep(classes.tile(slot));
      }
    }
  }
  std::vector<std::byte> bytes;

 private:
  void keep(const window::Tile& tile) {
    for (std::size_t group = 0; group < window::kGroupsPerTile; ++group) {
      if (tile.is_known(group)) {
        append(tile.free[group], bytes);
        append(tile.taken[group], bytes);
      }
    }
    append(tile.aged_at, bytes);
    append(tile.evidence_at, bytes);
    append(tile.is_free_alone, bytes);
    append(tile.found, bytes);
    append(tile.ground, bytes);
  }
};

template <typename AnyPipeline>
void step(AnyPipeline& pipeline, const TimedDatagram& datagram) {
  while (pipeline.deadline_us() <= datagram.now_us) {
    pipeline.tick(pipeline.deadline_us());
  }
  pipeline.take({kReplayer, datagram.port, datagram.bytes}, datagram.now_us);
}
template <typename AnyPipeline>
void take(AnyPipeline& pipeline, const Drive& drive) {
  pipeline.start(drive.front().now_us);
  for (const TimedDatagram& datagram : drive) {
    step(pipeline, datagram);
  }
  pipeline.tick(pipeline.deadline_us());
}

inline Drive sorted(Drive drive) {
  std::ranges::stable_sort(drive, {}, &TimedDatagram::now_us);
  return drive;
}

// Frames with classes.
struct ClassBench {
  using Classes = PerceptionPipeline<SharingPlatform, Masses>;

  ClassBench(SharingPlatform& its, const vehicle::Vehicle& like, bool is_synchronised = true,
             std::uint32_t latency_us = 0)
      : platform(its),
        car(like, is_synchronised, latency_us),
        pipeline(std::make_unique<Classes>(car.vehicle(), kReplayer, platform, masses)) {}

  [[nodiscard]] Played play(const Drive& drive) {
    take(*pipeline, drive);
    return {platform.messages, masses.bytes};
  }

  SharingPlatform& platform;
  Car car;
  Masses masses;
  std::unique_ptr<Classes> pipeline;
};

// Three LUX that sweep one after the other towards walls, so that their points share slices, lines
// and cells. There are no poses before the second frame, so that packets without a place are
// fused, too. log2_slice_ms: slices of 1 ms are more than a round has room for.
inline Played play_three_lux(SharingPlatform& platform, int parts, std::uint8_t log2_slice_ms) {
  constexpr int kFrames = 5;
  Drive drive = poses(kPeriodUs, kFrames * kPeriodUs);
  for (int frame = 1; frame <= kFrames; ++frame) {
    for (const int sensor : {0, 1, 2}) {
      const std::uint64_t end_us = static_cast<std::uint64_t>(frame) * kPeriodUs -
                                   3'000 * static_cast<std::uint64_t>(sensor);
      std::ranges::move(scan_of_wall(static_cast<std::uint16_t>(100 + sensor), frame, parts, end_us,
                                     25 + 4 * sensor),
                        std::back_inserter(drive));
    }
  }
  vehicle::Vehicle car = tests::ThreeLux::kVehicle;
  car.poses.log2_slice_ms = log2_slice_ms;
  return ClassBench(platform, car).play(sorted(drive));
}

// A car that turns while it drives, among things that come and go: a scan a frame, which lasts two
// slices. In the last frame but one a period of the ground begins.
inline constexpr int kFirstOnCircle = 10;
inline constexpr int kFramesOnCircle = 5;

inline pose::Message on_circle(std::uint64_t time_us) {
  constexpr double kYawRate = 0.5;  // rad/s
  constexpr double kRadiusMm = 1000 * kSpeedMps / kYawRate;
  const double angle = kYawRate * static_cast<double>(time_us) / 1e6;
  pose::Message message = pose_at(time_us);
  message.pose = {
      .x_mm = static_cast<std::int32_t>(std::lround(kRadiusMm * std::sin(angle))),
      .y_mm = static_cast<std::int32_t>(std::lround(kRadiusMm * (1 - std::cos(angle)))),
      .heading = static_cast<std::uint32_t>(std::llround(angle / (2 * std::numbers::pi) * 0x1p32))};
  message.yaw_urad_per_s = 500'000;
  return message;
}

// By packets of so many ticks of the scanner's angle.
inline Drive circle(int packet_ticks = 800) {
  constexpr std::uint64_t kEndUs = (kFirstOnCircle + kFramesOnCircle) * kPeriodUs;
  Drive drive;
  tests::Random random(5);
  for (std::uint64_t us = (kFirstOnCircle - 1) * kPeriodUs; us < kEndUs; us += 10'000) {
    drive.push_back(datagram_of(on_circle(us)));
  }
  for (int frame = kFirstOnCircle; frame < kFirstOnCircle + kFramesOnCircle; ++frame) {
    const std::uint64_t end_us = static_cast<std::uint64_t>(frame) * kPeriodUs - 1'000;
    int range_cm = 2'000;
    for (int left = 1600; left > -1600; left -= packet_ticks) {
      tests::LuxMessage part{.scan_number = frame,
                             .start_ticks = left,
                             .end_ticks = left - packet_ticks,
                             .points = {},
                             .start_ntp = ntp_of(kStartUs + end_us - kSweepUs),
                             .end_ntp = ntp_of(kStartUs + end_us)};
      for (int ticks = left; ticks > left - packet_ticks; ticks -= 16) {
        range_cm = random.one_in(12) ? random.between(400, 4'800) : range_cm;
        part.points.push_back(
            {.layer = 2, .angle_ticks = ticks, .range_cm = range_cm + 8 * random.between(-1, 1)});
      }
      drive.push_back({end_us, 100, part.bytes()});
    }
  }
  return sorted(drive);
}

// A little more for each step of an index.
consteval evidence::Assignment make_graded() {
  evidence::Assignment graded;
  for (std::size_t n = 0; n < evidence::kGradedIndexes; ++n) {
    graded.occupied[n] = static_cast<std::uint8_t>(3 * n);
    graded.free[n] = static_cast<std::uint8_t>(n);
  }
  return graded;
}
inline constexpr evidence::Assignment kGraded = make_graded();

// With these, how often a cell was hit or crossed in a frame shows; with none, cells that are free
// alone take a way of their own.
inline constexpr perception::Rules kGradedRules{.assignment = &kGraded};

inline vehicle::Vehicle car_on_circle(const perception::Rules& rules) {
  vehicle::Vehicle car = tests::OneLux::kVehicle;
  car.window = rules;
  car.has_objects = true;
  return car;
}
inline Played play_circle(SharingPlatform& platform, const perception::Rules& rules) {
  return ClassBench(platform, car_on_circle(rules)).play(circle());
}
inline Played play_short_slices(SharingPlatform& platform) {
  vehicle::Vehicle car = car_on_circle({});
  car.poses.log2_slice_ms = 0;
  return ClassBench(platform, car).play(circle(200));
}

// Turns of a VLP-16 at 5 Hz (User Manual 63-9243): an azimuth in 110.592 us and 0.2 degrees on.
// With two returns a packet has six of them, with one twelve. Walls are everywhere, at any range up
// to so many units of 2 mm; every fifth shot comes back from nowhere.
inline Drive turns_of_vlp16(std::uint16_t port, int turns, bool is_dual, int range) {
  constexpr int kStep = 20;
  const int azimuths = is_dual ? 6 : 12;
  tests::Random random(port);
  Drive drive;
  for (int packet = 0; packet < turns * 36'000 / (azimuths * kStep); ++packet) {
    const int us = static_cast<int>(packet * azimuths * 110.592);
    tests::VelodynePacket sent{.first_azimuth = packet * azimuths * kStep % 36'000,
                               .step = kStep,
                               .mode = is_dual ? 0x39 : 0x37,
                               .time_us = static_cast<std::uint32_t>(us)};
    for (auto& block : sent.ranges) {
      for (int& unit : block) {
        const auto more = random.one_in(5) ? -1'500 : random.between(0, range - 1'501);
        unit = 1'500 + more;
      }
    }
    drive.push_back({1'000'000 + static_cast<std::uint64_t>(us), port, sent.bytes()});
  }
  return drive;
}

// One unit, three turns: six parts each for four cores, and what is left.
inline Drive three_turns() { return turns_of_vlp16(100, 3, false, 25'000); }
inline constexpr std::size_t kPacketsOfTurn = 150;

// A unit that follows the ground: its second and third turn are judged by what was seen before.
inline const vehicle::Vehicle& ground_vlp16() {
  static const tests::GroundCar car(tests::LevelVlp16::kVehicle, {220, 2'200}, {600, 300});
  return car.vehicle();
}

// Frames with classes of a fifth of a turn; the ground is renewed with every fifth or sixth of
// them.
inline Played play_parts_of_turns(SharingPlatform& platform, const vehicle::Vehicle& like) {
  Drive drive = three_turns();
  std::ranges::move(poses(900'000, 1'700'000), std::back_inserter(drive));
  return ClassBench(platform, like, false, 5'000).play(sorted(drive));
}

// Frames without, of a turn each.
inline Played play_turns(SharingPlatform& platform, vehicle::Vehicle car, const Drive& drive) {
  car.frame_period_us = 300'000;
  const auto pipeline = std::make_unique<Pipeline<SharingPlatform>>(car, kReplayer, platform);
  take(*pipeline, drive);
  return {platform.messages, {}};
}
// Each packet comes in the place of another one of its turn.
inline Played play_shuffled_turns(SharingPlatform& platform) {
  Drive drive = three_turns();
  tests::Random random(7);
  for (std::size_t i = 0; i < drive.size(); ++i) {
    const std::size_t turn = i / kPacketsOfTurn * kPacketsOfTurn;
    std::swap(drive[i].bytes, drive[turn + random.below(kPacketsOfTurn)].bytes);
  }
  return play_turns(platform, ground_vlp16(), drive);
}
// Two units with two returns: in a frame they have more points than parts that are full have
// places. The units' own limits are those of a turn at 10 Hz, and are raised.
inline Played play_full_frames(SharingPlatform& platform) {
  vehicle::Vehicle car = tests::MixedCar::kVehicle;
  std::vector<vehicle::Sensor> sensors(car.sensors.begin(), car.sensors.end());
  for (vehicle::Sensor& sensor : sensors) {
    sensor.max_points_per_scan = lidar::turns(sensor.format) ? 120'000 : sensor.max_points_per_scan;
  }
  car.sensors = sensors;
  Drive drive = turns_of_vlp16(100, 2, true, 4'000);
  std::ranges::move(turns_of_vlp16(101, 2, true, 4'000), std::back_inserter(drive));
  return play_turns(platform, car, sorted(drive));
}
inline Played play_bayes(SharingPlatform& platform) {
  vehicle::Vehicle car = tests::LevelVlp16::kVehicle;
  car.rule = vehicle::FusionRule::kBayes;
  return play_turns(platform, car, three_turns());
}

// Tiles of a made-up drive, more than are encoded in a round: most stay as they were, some change a
// little, some all over. least, most: of what a cell becomes.
class MadeUpTiles {
 public:
  static constexpr std::size_t kCount = 300;

  explicit MadeUpTiles(std::uint64_t seed) : random_(seed) {}
  void change(std::size_t i, int least, int most) {
    const int changes = random_.one_in(8) ? 1024 : random_.one_in(2) ? 5 : 0;
    for (int change = 0; change < changes; ++change) {
      auto& cell = tiles_[i][random_.below(tile_coding::kTileBytes)];
      cell = static_cast<std::byte>(random_.between(least, most));
    }
  }
  void clear(std::size_t i) { tiles_[i].fill({}); }
  [[nodiscard]] bool is_chosen(int one_in) { return random_.one_in(one_in); }
  [[nodiscard]] tile_coding::TileCells at(std::size_t i) const { return tiles_[i]; }

 private:
  tests::Random random_;
  std::array<std::array<std::byte, tile_coding::kTileBytes>, kCount> tiles_{};
};

inline constexpr std::uint32_t kMadeUpFrames = 20;

inline Played play_tiles(SharingPlatform& platform) {
  const auto sink = std::make_unique<NetworkSink<SharingPlatform>>(platform, Coding::kShortest);
  const auto tiles = std::make_unique<MadeUpTiles>(7);
  for (std::uint32_t frame = 0; frame < kMadeUpFrames; ++frame) {
    sink->begin_frame({.frame_number = frame});
    for (std::size_t i = 0; i < MadeUpTiles::kCount; ++i) {
      tiles->change(i, -14, 2);
      sink->take_tile(3 * i, tiles->at(i));
    }
    sink->end_frame();
  }
  return {platform.messages, {}};
}

// Tiles of classes: some have no class, more than half stay from frame to frame. are_told: whether
// a tile that stays is said to; else each is looked at in each frame.
inline Played play_class_tiles(SharingPlatform& platform, bool are_told) {
  MessageSender<SharingPlatform> messages(platform);
  const auto sender = std::make_unique<TileSender<SharingPlatform, stream::ClassHash>>(
      platform, messages, Coding::kShortest);
  const auto tiles = std::make_unique<MadeUpTiles>(11);
  std::vector<std::uint32_t> versions(MadeUpTiles::kCount, 1);
  Played played;
  for (std::uint32_t frame = 0; frame < kMadeUpFrames; ++frame) {
    sender->begin({.frame_number = frame}, {.corner_a = -3, .corner_b = 8});
    for (std::size_t i = 0; i < MadeUpTiles::kCount; ++i) {
      if (!tiles->is_chosen(2)) {
        ++versions[i];
        if (tiles->is_chosen(9)) {
          tiles->clear(i);
        }
        tiles->change(i, 0, 47);
      }
      sender->add_classes(3 * i, tiles->at(i), static_cast<std::uint8_t>(frame % 5),
                          are_told ? versions[i] : frame + 1);
    }
    append(sender->finish().crc, played.beside);
  }
  played.messages = platform.messages;
  return played;
}

}  // namespace iog::app::testing
