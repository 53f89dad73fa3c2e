// What dividing the fusing of a frame among cores would bring, by the way of dividing it.
#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

#include "lab/experiments/experiments.hpp"
#include "lab/experiments/fusing_splits.hpp"
#include "lab/experiments/fusing_threads.hpp"
#include "lab/experiments/target_drive.hpp"
#include "tools/simulate/drives/drive.hpp"

namespace iog::lab {
namespace {

constexpr std::uint32_t kEveryFrame = 5;
constexpr std::array kCellsM{0.1, 0.2};
constexpr std::array<std::size_t, 3> kCoreCounts{1, 2, 4};

// The scanners of one car, and of another one on the same roof.
struct Rig {
  std::string_view name;
  std::size_t lux;  // the first ones of the reference car
  bool has_turning = false;
};
constexpr std::array kRigs{Rig{"two_lux", 2}, Rig{"four_lux", 4}, Rig{"four_lux_and_64", 4, true}};
constexpr std::string_view kTurningCar = "roof_os1_64";

struct Sums {
  std::uint64_t frames = 0;
  Effort effort;
  double longest = 0;
  double longest_frame = 0;
  double busy = 0;

  void add(const Division& division) {
    const Effort& its = division.effort;
    ++frames;
    effort.points += its.points;
    effort.lines += its.lines;
    effort.blocks += its.blocks;
    effort.marks += its.marks;
    effort.entries += its.entries;
    effort.tiles += its.tiles;
    effort.lines_shared += its.lines_shared;
    longest += division.longest();
    longest_frame = std::max(longest_frame, division.longest());
    busy += division.busy();
  }
};

// Both cars go by the same road. A turn takes two and a half frames of the LUX.
std::vector<FusingWork> works_of(std::string_view scene, const Rig& rig, const BlockPlane& plane) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  const tools::CatalogueEntry& turning_car = tools::find_vehicle(kTurningCar);
  tools::Drive drive(car, kTargetSeed, kTargetSeconds, tools::find_scene(scene));
  tools::Drive turning(turning_car, kTargetSeed, kTargetSeconds, tools::find_scene(scene));
  std::vector<FusingWork> works;
  for (std::uint32_t frame = 0; frame < drive.frame_count(); frame += kEveryFrame) {
    FusingWork work = work_of(car, drive.datagrams(frame), plane);
    std::erase_if(work.lines, [&rig](const LineWork& line) { return line.sensor >= rig.lux; });
    if (rig.has_turning) {
      const std::uint32_t turn = frame * turning.frames_per_second() / drive.frames_per_second();
      append(work, work_of(turning_car, turning.datagrams(turn), plane), rig.lux);
    }
    works.push_back(std::move(work));
  }
  return works;
}

void add_rows(Table& table, std::string_view scene, const Rig& rig, double cell_m) {
  const BlockPlane plane{cell_m};
  const std::vector<FusingWork> works = works_of(scene, rig, plane);
  for (std::size_t split = 0; split < kSplitNames.size(); ++split) {
    for (const std::size_t cores : kCoreCounts) {
      Sums sums;
      for (const FusingWork& work : works) {
        sums.add(divide(work, plane, static_cast<Split>(split), cores));
      }
      const Effort& its = sums.effort;
      table.row(scene, rig.name, cell_m, kSplitNames[split], cores, sums.frames, its.points,
                its.lines, its.blocks, its.marks, its.entries, its.tiles, its.lines_shared,
                sums.longest, sums.longest_frame, sums.busy);
    }
  }
}

}  // namespace

Tables four_cores(const Input& /*input*/) {
  Table table("four_cores", {"scene", "sensors", "cell_m", "split", "cores", "frames", "points",
                             "lines", "blocks", "marks", "entries", "tiles", "lines_shared",
                             "longest_cycles", "longest_frame_cycles", "busy_cycles"});
  for (const std::string_view scene : {"ring_road", "city"}) {
    for (const Rig& rig : kRigs) {
      for (const double cell_m : kCellsM) {
        add_rows(table, scene, rig, cell_m);
      }
    }
  }
  return {table};
}

Tables two_threads(const Input& /*input*/) {
  Table times("four_cores_on_this_pc", {"scene", "time_of_one_by_time_of_two"});
  for (const std::string_view scene : {"ring_road", "city"}) {
    times.row(scene, time_ratio_of_two_threads(scene));
  }
  return {times};
}

}  // namespace iog::lab
