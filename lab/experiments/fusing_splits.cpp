#include "lab/experiments/fusing_splits.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numeric>
#include <utility>

namespace iog::lab {
namespace {

constexpr std::uint32_t kRowsOfARegion = 2;
constexpr std::uint64_t kLinesOfATile = 32;

// Of a mean frame of four LUX, by the cost model: cycles of `beams` by points, of `mark` by marks,
// what the lines and blocks of the ring road and of the city make of the two figures of `carve`,
// and of frames with classes on the ring road BlockGrid::copy_tile() with clear_tile(), and
// JoinedGrid::add(), by tiles. Estimates:
//   shared_block  LDREX, UQADD8, STREX and their branches, 14 cycles for each of the 2.5 rows of
//                 four cells that a line has in a block, and what a block waits for memory
//   entry         two quotients and a sum over the codes before it
//   round         a wake, an interrupt, two swaps and the last core's flag
constexpr UnitCosts kNominal{.point = 364,
                             .line = 277,
                             .block = 19.5,
                             .mark = 31,
                             .shared_block = 43,
                             .entry = 150,
                             .tile = 1400,
                             .joined = 1800,
                             .round = 2000};

struct Item {
  double cycles = 0;
  std::vector<const LineWork*> lines;
};

using Items = std::vector<Item>;

double cycles_of(const LineWork& line, const UnitCosts& costs) {
  const auto blocks = static_cast<double>(line.blocks.size());
  return line.points * costs.point + (line.blocks.empty() ? 0 : costs.line) + blocks * costs.block +
         static_cast<double>(line.marks.size()) * costs.mark;
}

void add(const LineWork& line, Effort& effort) {
  effort.points += line.points;
  effort.lines += line.blocks.empty() ? 0U : 1U;
  effort.blocks += line.blocks.size();
  effort.marks += line.marks.size();
}

// Lines that have the same key, in the order in which the keys are met.
template <typename Key>
Items items_by(const FusingWork& work, const UnitCosts& costs, Key&& key_of) {
  std::map<std::size_t, std::size_t> places;
  Items items;
  for (const LineWork& line : work.lines) {
    const auto [at, is_new] = places.try_emplace(key_of(line), items.size());
    if (is_new) {
      items.emplace_back();
    }
    items[at->second].lines.push_back(&line);
    items[at->second].cycles += cycles_of(line, costs);
  }
  return items;
}

std::vector<double> loads_of(const Items& items, const std::vector<std::size_t>& core_of,
                             std::size_t cores) {
  std::vector<double> loads(cores);
  for (std::size_t i = 0; i < items.size(); ++i) {
    loads[core_of[i]] += items[i].cycles;
  }
  return loads;
}

std::vector<double> dealt(const std::vector<double>& items, std::size_t cores) {
  std::vector<double> loads(cores);
  const std::vector<std::size_t> core_of = deal(items, cores);
  for (std::size_t i = 0; i < items.size(); ++i) {
    loads[core_of[i]] += items[i];
  }
  return loads;
}

std::vector<double> cycles_of(const Items& items) {
  std::vector<double> cycles(items.size());
  std::ranges::transform(items, cycles.begin(), &Item::cycles);
  return cycles;
}

// A bit for each core that touches a tile, or a cache line of two blocks beside one another.
struct Touched {
  explicit Touched(const BlockPlane& plane)
      : tiles(plane.tile_count()),
        lines(static_cast<std::size_t>(plane.side()) * static_cast<std::size_t>(plane.side()) / 2) {
  }

  void add(const BlockPlane& plane, std::uint32_t block, std::size_t core) {
    tiles[plane.tile_of(block)] |= 1U << core;
    lines[block / 2] |= 1U << core;
  }

  std::vector<unsigned> tiles;
  std::vector<unsigned> lines;
};

Touched touched_by(const Items& items, const std::vector<std::size_t>& core_of,
                   const BlockPlane& plane) {
  Touched touched(plane);
  for (std::size_t i = 0; i < items.size(); ++i) {
    for (const LineWork* line : items[i].lines) {
      for (const std::uint32_t block : line->blocks) {
        touched.add(plane, block, core_of[i]);
      }
      for (const std::uint32_t block : line->marks) {
        touched.add(plane, block, core_of[i]);
      }
    }
  }
  return touched;
}

// Each tile of each grid is read, and added to the others. Of grids that are not its own a core
// gets the lines from elsewhere.
void hand_out(const Touched& touched, const BlockPlane& plane, const UnitCosts& costs,
              std::size_t cores, Division& division) {
  std::vector<double> rows(plane.tile_rows());
  for (std::size_t tile = 0; tile < touched.tiles.size(); ++tile) {
    const auto grids = static_cast<unsigned>(std::popcount(touched.tiles[tile]));
    const unsigned further = grids > 1 ? grids - 1 : 0;
    rows[tile / plane.tile_rows()] += grids * costs.tile + further * costs.joined;
    division.effort.tiles += grids;
    division.effort.lines_shared += kLinesOfATile * grids * (cores - 1) / cores;
  }
  division.cycles.push_back(dealt(rows, cores));
}

void add_all(const FusingWork& work, Effort& effort) {
  for (const LineWork& line : work.lines) {
    add(line, effort);
  }
}

Division on_own_grids(const Items& items, const std::vector<std::size_t>& core_of,
                      const BlockPlane& plane, std::size_t cores, const UnitCosts& costs) {
  Division division;
  division.cycles.push_back(loads_of(items, core_of, cores));
  hand_out(touched_by(items, core_of, plane), plane, costs, cores, division);
  return division;
}

// All in one grid.
Touched touched_by_all(const FusingWork& work, const BlockPlane& plane) {
  Item all;
  for (const LineWork& line : work.lines) {
    all.lines.push_back(&line);
  }
  return touched_by({all}, {0}, plane);
}

// Sub-groups of beams that follow one another, by their number, of all sensors, as in the paper.
std::vector<std::size_t> sub_groups(const Items& items, std::size_t cores) {
  std::vector<std::size_t> core_of(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    core_of[i] = i * cores / items.size();
  }
  return core_of;
}

// All beams of a number, that is of an azimuth.
Items beams_of(const FusingWork& work, const UnitCosts& costs) {
  std::map<std::uint32_t, Item> beams;
  for (const LineWork& line : work.lines) {
    Item& beam = beams[line.azimuth];
    beam.lines.push_back(&line);
    beam.cycles += cycles_of(line, costs);
  }
  Items items;
  for (auto& [azimuth, beam] : beams) {
    items.push_back(std::move(beam));
  }
  return items;
}

Division by_beams_shared(const FusingWork& work, const BlockPlane& plane, std::size_t cores,
                         UnitCosts costs) {
  if (cores > 1) {
    costs.block = costs.shared_block;
  }
  const Items items = beams_of(work, costs);
  const std::vector<std::size_t> core_of = sub_groups(items, cores);
  Division division;
  division.cycles.push_back(loads_of(items, core_of, cores));
  for (const unsigned by : touched_by(items, core_of, plane).lines) {
    division.effort.lines_shared += std::popcount(by) > 1 ? 1U : 0U;
  }
  hand_out(touched_by_all(work, plane), plane, costs, cores, division);
  return division;
}

// What a line is in some rows of tiles.
struct InRows {
  bool begins = false;
  std::size_t blocks = 0;
  std::size_t marks = 0;
};

InRows in_rows(const LineWork& line, const BlockPlane& plane, std::uint32_t first,
               std::uint32_t end) {
  const auto lies = [&](std::uint32_t block) {
    const std::uint32_t row = plane.tile_row_of(block);
    return first <= row && row < end;
  };
  return {!line.blocks.empty() && lies(line.blocks.front()),
          static_cast<std::size_t>(std::ranges::count_if(line.blocks, lies)),
          static_cast<std::size_t>(std::ranges::count_if(line.marks, lies))};
}

// Carving and marking in some rows of tiles.
double carve_rows(const FusingWork& work, const BlockPlane& plane, std::uint32_t first,
                  std::uint32_t end, const UnitCosts& costs, Effort& effort) {
  double cycles = 0;
  for (const LineWork& line : work.lines) {
    const InRows here = in_rows(line, plane, first, end);
    if (here.begins) {
      ++effort.lines;
      cycles += costs.line;
    } else if (here.blocks > 0) {
      ++effort.entries;
      cycles += costs.entry;
    }
    cycles += static_cast<double>(here.blocks) * costs.block +
              static_cast<double>(here.marks) * costs.mark;
    effort.blocks += here.blocks;
    effort.marks += here.marks;
  }
  return cycles;
}

// Equal parts of the grid, and every core turns all points to beams.
Division by_cells(const FusingWork& work, const BlockPlane& plane, std::size_t cores,
                  const UnitCosts& costs) {
  Division division;
  std::vector<double> loads;
  for (std::size_t core = 0; core < cores; ++core) {
    const auto first = static_cast<std::uint32_t>(plane.tile_rows() * core / cores);
    const auto end = static_cast<std::uint32_t>(plane.tile_rows() * (core + 1) / cores);
    double cycles = carve_rows(work, plane, first, end, costs, division.effort);
    for (const LineWork& line : work.lines) {
      cycles += line.points * costs.point;
      division.effort.points += line.points;
    }
    loads.push_back(cycles);
  }
  division.cycles.push_back(loads);
  hand_out(touched_by_all(work, plane), plane, costs, cores, division);
  return division;
}

Division by_regions(const FusingWork& work, const BlockPlane& plane, std::size_t cores,
                    const UnitCosts& costs) {
  Division division;
  std::vector<double> packets(work.packets);
  for (const LineWork& line : work.lines) {
    packets[line.packet] += line.points * costs.point;
    division.effort.points += line.points;
  }
  division.cycles.push_back(dealt(packets, cores));
  const std::uint32_t rows = cores > 1 ? kRowsOfARegion : plane.tile_rows();
  std::vector<double> regions;
  for (std::uint32_t row = 0; row < plane.tile_rows(); row += rows) {
    regions.push_back(carve_rows(work, plane, row, row + rows, costs, division.effort));
  }
  division.cycles.push_back(dealt(regions, cores));
  hand_out(touched_by_all(work, plane), plane, costs, cores, division);
  return division;
}

Division by_pipeline(const FusingWork& work, const BlockPlane& plane, std::size_t cores,
                     const UnitCosts& costs) {
  std::array<double, 3> stages{};
  for (const LineWork& line : work.lines) {
    const double points = line.points * costs.point;
    const double marks = static_cast<double>(line.marks.size()) * costs.mark;
    stages[0] += points;
    stages[1] += cycles_of(line, costs) - points - marks;
    stages[2] += marks;
  }
  Division division;
  hand_out(touched_by_all(work, plane), plane, costs, 1, division);
  stages[2] += division.busy();
  std::vector<double> loads(cores);
  for (std::size_t stage = 0; stage < stages.size(); ++stage) {
    loads[std::min(stage, cores - 1)] += stages[stage];
  }
  division.cycles = {loads};
  return division;
}

Division by_sensors(const FusingWork& work, const BlockPlane& plane, std::size_t cores,
                    const UnitCosts& costs) {
  const Items items = items_by(work, costs, [](const LineWork& line) { return line.sensor; });
  return on_own_grids(items, deal(cycles_of(items), cores), plane, cores, costs);
}

Division by_packets(const FusingWork& work, const BlockPlane& plane, std::size_t cores,
                    const UnitCosts& costs) {
  const Items items = items_by(work, costs, [](const LineWork& line) { return line.packet; });
  return on_own_grids(items, deal(cycles_of(items), cores), plane, cores, costs);
}

Division by_beams_own(const FusingWork& work, const BlockPlane& plane, std::size_t cores,
                      const UnitCosts& costs) {
  const Items items = beams_of(work, costs);
  return on_own_grids(items, sub_groups(items, cores), plane, cores, costs);
}

Division divided(const FusingWork& work, const BlockPlane& plane, Split split, std::size_t cores,
                 const UnitCosts& costs) {
  switch (split) {
    case Split::kCells:
      return by_cells(work, plane, cores, costs);
    case Split::kBeamsShared:
      return by_beams_shared(work, plane, cores, costs);
    case Split::kBeamsOwn:
      return by_beams_own(work, plane, cores, costs);
    case Split::kSensors:
      return by_sensors(work, plane, cores, costs);
    case Split::kPackets:
      return by_packets(work, plane, cores, costs);
    case Split::kRegions:
      return by_regions(work, plane, cores, costs);
    case Split::kPipeline:
      break;
  }
  return by_pipeline(work, plane, cores, costs);
}

}  // namespace

const UnitCosts& nominal_costs() { return kNominal; }

std::vector<std::size_t> deal(std::span<const double> items, std::size_t cores) {
  std::vector<double> loads(cores);
  std::vector<std::size_t> core_of;
  for (const double item : items) {
    const auto idle = std::ranges::min_element(loads);
    *idle += item;
    core_of.push_back(static_cast<std::size_t>(idle - loads.begin()));
  }
  return core_of;
}

double Division::longest() const {
  double sum = 0;
  for (const std::vector<double>& phase : cycles) {
    sum += std::ranges::max(phase);
  }
  return sum;
}

double Division::busy() const {
  double sum = 0;
  for (const std::vector<double>& phase : cycles) {
    sum = std::accumulate(phase.begin(), phase.end(), sum);
  }
  return sum;
}

Division divide(const FusingWork& work, const BlockPlane& plane, Split split, std::size_t cores,
                const UnitCosts& costs) {
  Division division = divided(work, plane, split, cores, costs);
  const bool counts_lines = split == Split::kCells || split == Split::kRegions;
  if (!counts_lines) {
    add_all(work, division.effort);
  }
  if (cores > 1) {
    for (std::vector<double>& phase : division.cycles) {
      phase.front() += costs.round;
    }
  }
  return division;
}

}  // namespace iog::lab
