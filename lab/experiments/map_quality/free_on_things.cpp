// Where the cells are that are called free and have something on them: what it is, how far within
// its outline, when beams last told of the cell, and what was there then.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>
#include <vector>

#include "lab/evaluation/class_truth.hpp"
#include "lab/experiments/experiments.hpp"
#include "lab/experiments/map_quality/world_cells.hpp"
#include "lab/experiments/perception/perceived_drive.hpp"

namespace iog::lab {
namespace {

constexpr std::array<std::string_view, 3> kFreeScenes{"city", "street", "ring_road"};
constexpr std::uint64_t kFreeSeed = 21;
constexpr std::uint32_t kFreeSeconds = 6;
constexpr std::uint32_t kFirstScored = 50;  // as map_quality scores them
constexpr std::uint32_t kScoredEvery = 10;
constexpr std::size_t kCells = std::size_t{window::kCellsAcross} * window::kCellsAcross;

// What beams told of a cell of the window, the last time they did.
struct LastLook {
  geometry::Cell cell{};  // of the local frame: another one has left the window
  std::uint32_t frame = 0;
  tools::TrueClass truth = tools::TrueClass::kFree;  // of the cell, at that frame's end
  bool is_known = false;
};

using Group = std::tuple<std::string_view, std::string_view, std::string_view, std::string_view,
                         std::string_view>;

class FreeCells {
 public:
  void add(const PerceivedFrame& frame, const LocalToWorld& to_world) {
    const WorldCells world(frame);
    const bool is_scored =
        frame.number >= kFirstScored && frame.number % kScoredEvery == kScoredEvery - 1;
    for (std::size_t place = 0; place < kCells; ++place) {
      const bool is_seen = frame.evidence[place] != 0;
      const auto called = static_cast<std::size_t>(frame.classes.front()[place]) / 8;
      const bool is_counted = is_scored && called == kFree;
      if (is_seen || is_counted) {
        const geometry::Cell cell = frame.window.cell_at(place);
        const tools::TrueClass truth = world.at(to_world.centre_of(cell));
        LastLook& look = look_of(cell);
        if (is_seen) {
          look = {.cell = cell, .frame = frame.number, .truth = truth, .is_known = true};
        }
        if (is_counted) {
          count(frame, world, to_world, cell, truth, look);
        }
      }
    }
  }

  void append_to(std::string_view scene, Table& table) const {
    for (const auto& [group, cells] : cells_) {
      const auto& [truth, then, age, depth, range] = group;
      table.row(scene, truth, then, age, depth, range, cells);
    }
  }

 private:
  static constexpr std::size_t kFree = 3;  // of class bytes, without a map the only free one

  LastLook& look_of(geometry::Cell cell) {
    constexpr std::uint32_t kMask = window::kCellsAcross - 1;
    LastLook& look =
        looks_[std::size_t{static_cast<std::uint32_t>(cell.y) & kMask} * window::kCellsAcross +
               (static_cast<std::uint32_t>(cell.x) & kMask)];
    if (look.cell != cell) {
      look = {.cell = cell};
    }
    return look;
  }

  void count(const PerceivedFrame& frame, const WorldCells& world, const LocalToWorld& to_world,
             geometry::Cell cell, tools::TrueClass truth, const LastLook& look) {
    const bool is_covered = truth != tools::TrueClass::kFree;
    ++cells_[is_covered ? Group{name_of(truth), then_of(look), age_of(frame.number - look.frame),
                                depth_of(world, to_world, cell), range_of(frame, cell)}
                        : Group{"free", "-", "-", "-", "-"}];
  }

  static std::string_view name_of(tools::TrueClass truth) {
    return truth == tools::TrueClass::kMoving    ? "moving"
           : truth == tools::TrueClass::kMovable ? "stands"
                                                 : "fixed";
  }

  // What was in the cell when beams last told of it.
  static std::string_view then_of(const LastLook& look) {
    if (!look.is_known) {
      return "never";
    }
    return look.truth == tools::TrueClass::kFree ? "free" : "covered";
  }

  static std::string_view age_of(std::uint32_t frames) {
    return frames == 0 ? "this frame" : frames <= 5 ? "0.2 s" : "longer";
  }

  // How many cells around it are covered, too, on all sides.
  static std::string_view depth_of(const WorldCells& world, const LocalToWorld& to_world,
                                   geometry::Cell cell) {
    const auto is_open = [&](std::int32_t reach) {
      for (std::int32_t y = -reach; y <= reach; ++y) {
        for (std::int32_t x = -reach; x <= reach; ++x) {
          if (world.at(to_world.centre_of({cell.x + x, cell.y + y})) == tools::TrueClass::kFree) {
            return true;
          }
        }
      }
      return false;
    };
    return is_open(1) ? "edge" : is_open(2) ? "second" : "inside";
  }

  static std::string_view range_of(const PerceivedFrame& frame, geometry::Cell cell) {
    const geometry::Cell car = window::cell_of(frame.engine->slices().back().pose);
    const std::int64_t x = cell.x - car.x;
    const std::int64_t y = cell.y - car.y;
    const std::int64_t square = x * x + y * y;
    return square < 150 * 150 ? "15 m" : square < 300 * 300 ? "30 m" : "farther";
  }

  std::vector<LastLook> looks_ = std::vector<LastLook>(kCells);
  std::map<Group, std::uint64_t> cells_;
};

}  // namespace

Tables free_on_things(const Input& /*input*/) {
  Table table("free_on_things",
              {"scene", "truth", "truth_when_seen", "last_seen", "depth", "range", "cells"});
  constexpr std::array kOneRule{PerceptionRule{"default"}};
  for (const std::string_view scene : kFreeScenes) {
    const PerceivedDrive drive{
        .scene = scene, .seed = kFreeSeed, .seconds = kFreeSeconds, .shown_every = 1};
    FreeCells cells;
    LocalToWorld to_world;
    perceive_drive(drive, kOneRule, [&](const PerceivedFrame& frame) {
      to_world = FrameTruth(frame, to_world).last().to_world;
      if (!frame.classes.empty() && frame.end->slice_count > 0) {
        cells.add(frame, to_world);
      }
    });
    cells.append_to(scene, table);
  }
  return {std::move(table)};
}

}  // namespace iog::lab
