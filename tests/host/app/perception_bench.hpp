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

// Keeps what each frame says of its place, and the class grid's name.
class ClassList {
 public:
  void begin_frame(const FrameReport& /*report*/) {}
  void take_tile(std::size_t /*tile*/, tile_coding::TileCells /*cells*/) {}
  void end_frame() {}
  void take_classes(const PerceptionReport& report, const window::WindowView& classes) {
    reports.push_back(report);
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
  std::vector<PerceptionReport> reports;
  std::vector<ClassName> names;
  std::vector<Cell> cells;  // of the newest frame, those that have a class
};

struct PerceptionBench {
  explicit PerceptionBench(const vehicle::Vehicle& vehicle)
      : pipeline(std::make_unique<PerceptionPipeline<tests::FakePlatform, ClassList>>(
            vehicle, kReplayer, platform, classes)) {}

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
  [[nodiscard]] const PerceptionReport& report() const { return classes.reports.back(); }
  [[nodiscard]] std::uint32_t slices_by(pose::Cause cause) const {
    return report().slice_causes[static_cast<std::size_t>(cause)];
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
