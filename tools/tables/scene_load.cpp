#include "tools/tables/scene_load.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "tools/catalogue/vehicle_catalogue.hpp"
#include "tools/evidence/frame_points.hpp"
#include "tools/simulate/drive.hpp"

namespace iog::tools {
namespace {

using Cells = std::span<const index::OccupancyIndex, grid::kCellCount>;

// The index of all cells of a block, or that there are several.
using Block = std::int16_t;
constexpr Block kMixed = 1000;

// Blocks of twice the side, from a square of `side` times `side` blocks.
std::vector<Block> merge(const std::vector<Block>& blocks, std::size_t side) {
  std::vector<Block> larger;
  larger.reserve(blocks.size() / 4);
  for (std::size_t y = 0; y < side; y += 2) {
    const Block* const low = &blocks[y * side];
    const Block* const high = low + side;
    for (std::size_t x = 0; x < side; x += 2) {
      const Block first = low[x];
      const bool is_one = first == low[x + 1] && first == high[x] && first == high[x + 1];
      larger.push_back(is_one ? first : kMixed);
    }
  }
  return larger;
}

// Sums over frames.
struct Census {
  double frames = 0;
  double known = 0;
  double leaves = 0;
  double nodes = 0;

  void add(Cells cells) {
    const std::size_t leaves_here = count_leaves(cells);
    const std::size_t inner_here = (leaves_here - 1) / 3;
    ++frames;
    known += static_cast<double>(std::ranges::count_if(
        cells, [](index::OccupancyIndex index) { return index != index::kUnknown; }));
    leaves += static_cast<double>(leaves_here);
    nodes += static_cast<double>(leaves_here + inner_here);
  }
};

}  // namespace

// The root is a leaf, and every mixed block has four parts in its place: three leaves more.
std::size_t count_leaves(Cells cells) {
  std::vector<Block> blocks(cells.begin(), cells.end());
  std::size_t leaves = 1;
  for (std::size_t side = vehicle::kCellsPerSide; side > 1; side /= 2) {
    blocks = merge(blocks, side);
    leaves += 3 * static_cast<std::size_t>(std::ranges::count(blocks, kMixed));
  }
  return leaves;
}

SceneLoad load_of(std::string_view scene, std::uint64_t seed, std::uint32_t seconds) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  vehicle::Vehicle vehicle = *car.vehicle;
  vehicle.rule = vehicle::FusionRule::kBayes;
  const auto fusion = std::make_unique<grid::FrameFusion>(vehicle);  // too large for the stack
  Drive drive(car, seed, seconds, find_scene(scene));
  std::vector<index::OccupancyIndex> storage(grid::kCellCount);
  const auto cells = std::span(storage).first<grid::kCellCount>();
  Census census;
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    drive.move_to(frame);
    fusion->clear();
    for (const SensorPoint& seen : points_of(drive, car)) {
      fusion->add(vehicle.sensors[seen.sensor], seen.point);
    }
    fusion->finish();
    fusion->copy_cells(cells);
    census.add(cells);
  }
  const double all_cells = static_cast<double>(grid::kCellCount) * census.frames;
  return {.known_cells = census.known / census.frames,
          .cells_per_leaf = all_cells / census.leaves,
          .cells_per_node = all_cells / census.nodes};
}

}  // namespace iog::tools
