// The perception engine on a fake platform, and what it shows of each frame.
#pragma once

#include <algorithm>
#include <iterator>
#include <memory>
#include <vector>

#include "app/pipeline.hpp"
#include "fakes/fake_platform.hpp"
#include "perception_drive.hpp"
#include "stream/class_hash.hpp"

namespace iog::app::testing {

// What is compared of two class grids.
struct ClassName {
  std::uint32_t tiles = 0;
  std::uint32_t crc = 0;
  friend bool operator==(const ClassName&, const ClassName&) = default;
};

// What a frame says of its place, and what does not go out.
struct PlaceReport {
  stream::ClassEnd end;
  std::uint64_t stamp_us = 0;
  bool is_forgotten = false;
};

// Keeps what each frame says of its place, and the class grid's name.
class ClassList {
 public:
  void begin_frame(const stream::Header& /*header*/) {}
  void take_tile(std::size_t /*tile*/, tile_coding::TileCells /*cells*/) {}
  void end_frame() {}
  void take_classes(const stream::ClassEnd& end, const window::WindowView& classes) {
    reports.push_back({.end = end});
    if (engine != nullptr) {
      reports.back().stamp_us = engine->stamp_us();
      reports.back().is_forgotten = engine->is_forgotten();
    }
    const window::TileNumber corner = classes.area().corner();
    stream::ClassHash hash({corner.a, corner.b});
    ClassName& name = names.emplace_back();
    cells.clear();
    std::array<std::int8_t, geometry::kTileCells> tile{};
    for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
      if (!classes.copy_classes(slot, tile)) {
        continue;
      }
      hash.add(slot, std::as_bytes(std::span(tile)));
      name = {name.tiles + 1, hash.value()};
      const window::TileNumber number = classes.area().tile_at(slot);
      for (std::int32_t i = 0; i < static_cast<std::int32_t>(tile.size()); ++i) {
        if (tile[static_cast<std::size_t>(i)] != 0) {
          cells.push_back({{number.a * 32 + i % 32, number.b * 32 + i / 32},
                           tile[static_cast<std::size_t>(i)] / 8});
        }
      }
    }
  }

  struct Cell {
    geometry::Cell at;
    int what;
  };
  const PerceptionEngine* engine = nullptr;
  std::vector<PlaceReport> reports;
  std::vector<ClassName> names;
  std::vector<Cell> cells;  // of the newest frame, those that have a class
};

struct PerceptionBench {
  explicit PerceptionBench(const vehicle::Vehicle& vehicle)
      : pipeline(std::make_unique<PerceptionPipeline<tests::FakePlatform, ClassList>>(
            vehicle, kReplayer, platform, classes)) {
    classes.engine = &pipeline->perception();
  }

  void take(std::vector<TimedDatagram> datagrams) {
    std::ranges::stable_sort(datagrams, {}, &TimedDatagram::now_us);
    for (const TimedDatagram& datagram : datagrams) {
      while (pipeline->deadline_us() <= datagram.now_us) {
        pipeline->tick(pipeline->deadline_us());
      }
      pipeline->take({kReplayer, datagram.port, datagram.bytes}, datagram.now_us);
    }
  }
  void pass_until(std::uint64_t now_us) {
    while (pipeline->deadline_us() <= now_us) {
      pipeline->tick(pipeline->deadline_us());
    }
  }
  [[nodiscard]] const PlaceReport& report() const { return classes.reports.back(); }
  [[nodiscard]] const stream::ClassEnd& end() const { return report().end; }
  [[nodiscard]] std::uint32_t slices_by(pose::Cause cause) const {
    return end().causes[static_cast<std::size_t>(cause)].slices;
  }

  tests::FakePlatform platform;
  ClassList classes;
  std::unique_ptr<PerceptionPipeline<tests::FakePlatform, ClassList>> pipeline;
};

inline constexpr double kWallM = 30.04;

// One LUX, frames 1 ... count, each a scan that ends with its period, and poses for all of them.
inline std::vector<TimedDatagram> drive_at_wall(int count, int parts = 4) {
  auto drive = poses(0, static_cast<std::uint64_t>(count) * kPeriodUs);
  for (int frame = 1; frame <= count; ++frame) {
    std::ranges::move(
        scan_of_wall(100, frame, parts, static_cast<std::uint64_t>(frame) * kPeriodUs, kWallM),
        std::back_inserter(drive));
  }
  return drive;
}

}  // namespace iog::app::testing
