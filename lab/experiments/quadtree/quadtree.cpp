// The grid in a quadtree: table 4.7 of the thesis and the rest of its section 4.3.2.2.
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "lab/evidence/frame_points.hpp"
#include "lab/experiments/experiments.hpp"
#include "lab/experiments/output_rates/scene_load.hpp"
#include "lab/experiments/quadtree/grids.hpp"
#include "lab/experiments/quadtree/pair.hpp"
#include "lab/experiments/quadtree/updates.hpp"

namespace iog::lab {
namespace {

using index::Quantisation;

constexpr std::array kScenes{"ring_road", "city"};  // the thesis's load, and a lighter one

struct Policy {
  const char* name;
  Quantisation quantisation;
};
constexpr std::array kPolicies{Policy{"blurring", Quantisation::kBlurring},
                               Policy{"nearest", Quantisation::kNearest}};

// A row of table 4.7. Section 4.3.2.1: an index has 8 bits at epsilon = 0.05 and 32 below; of 0.1
// it does not say.
struct Indexes {
  double epsilon;
  int bits;

  [[nodiscard]] std::int32_t limit() const { return bits == 8 ? kInt8Limit : kNoLimit; }
};
constexpr auto kIndexes = std::to_array<Indexes>({{1e-1, 8},
                                                  {1e-1, 32},
                                                  {kDefaultEpsilon, 8},
                                                  {kDefaultEpsilon, 32},
                                                  {1e-2, 32},
                                                  {1e-3, 32},
                                                  {1e-4, 32},
                                                  {1e-5, 32},
                                                  {1e-6, 32}});

// Fused in the tree is every tenth frame: enough for a mean.
constexpr std::uint32_t kFramesApart = 10;

// Calls use(evidence, frame) for every so many frames of the reference car's drive.
template <typename Use>
void for_each_frame(const char* scene, const Input& input, std::uint32_t step, Use&& use) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  tools::Drive drive(car, input.seed, input.seconds, tools::find_scene(scene));
  for (std::uint32_t frame = 0; frame < drive.frame_count(); frame += step) {
    use(project(*car.vehicle, points_of(drive, frame, car)), frame);
  }
}

// The leaves of the frames of a drive, added up.
struct Leaves {
  std::uint64_t frames = 0;
  std::uint64_t leaves = 0;
  std::uint64_t most_in_a_frame = 0;

  void add(std::uint64_t leaves_of_frame) {
    ++frames;
    leaves += leaves_of_frame;
    most_in_a_frame = std::max(most_in_a_frame, leaves_of_frame);
  }
};

using ByPolicy = std::array<Leaves, kPolicies.size()>;
using OfDrive = std::array<ByPolicy, kIndexes.size()>;

// All sensors of the reference car are alike.
ByStep<double> model_of_a_lux() {
  const auto& sensor = tools::find_vehicle(tools::kDefaultVehicle).sensors.front();
  return probabilities({.sigma_m = sensor.sigma_m, .cell_length_m = sensor.precision_mm / 1000.0});
}

OfDrive leaves_of(const char* scene, const Input& input) {
  const ByStep<double> model = model_of_a_lux();
  OfDrive result;
  for_each_frame(scene, input, 1, [&](const FrameEvidence& evidence, std::uint32_t /*frame*/) {
    for (std::size_t i = 0; i < kIndexes.size(); ++i) {
      for (std::size_t policy = 0; policy < kPolicies.size(); ++policy) {
        const auto values = indexes(model, kIndexes[i].epsilon, kPolicies[policy].quantisation);
        const auto sums =
            fuse_indexes(evidence, values, IndexRule::kSequential, kIndexes[i].limit());
        result[i][policy].add(
            count_leaves(std::span<const std::int32_t>(sums).first<geometry::kCellCount>()));
      }
    }
  });
  return result;
}

// Fused by the thesis's sum (equation 4.4). Leaves are only counted, no tree is built.
Table compactness(const Input& input) {
  Table table("quadtree_compactness", {"scene", "epsilon", "index_bits", "policy", "frames",
                                       "leaves", "most_leaves_of_a_frame"});
  for (const char* scene : kScenes) {
    const OfDrive drive = leaves_of(scene, input);
    for (std::size_t i = 0; i < kIndexes.size(); ++i) {
      for (std::size_t policy = 0; policy < kPolicies.size(); ++policy) {
        const Leaves& found = drive[i][policy];
        table.row(scene, kIndexes[i].epsilon, kIndexes[i].bits, kPolicies[policy].name,
                  found.frames, found.leaves, found.most_in_a_frame);
      }
    }
  }
  return table;
}

// Both trees of every frame, as the firmware fuses it, and of grids that no drive makes.
Table sizes(const Input& input) {
  Table table("quadtree_sizes", {"grid", "frame", "leaves", "nodes", "linear_bytes",
                                 "reference_bytes", "differing_cells", "differing_leaves"});
  QuadtreePair trees;
  const auto add = [&](const std::string& grid, std::uint32_t frame, GridCells cells) {
    const QuadtreeSize size = trees.build(cells, grid + ", frame " + std::to_string(frame));
    table.row(grid, frame, size.leaves, size.nodes, size.linear_bytes, size.reference_bytes,
              size.differing_cells, size.differing_leaves);
  };
  for (const char* scene : kScenes) {
    std::uint32_t frame = 0;
    fuse_drive(scene, input.seed, input.seconds, vehicle::FusionRule::kHitsWin,
               [&](GridCells cells) { add(scene, frame++, cells); });
  }
  for (const NamedGrid& grid : drawn_grids(input.seed)) {
    add(grid.name, 0, std::span(grid.cells).first<geometry::kCellCount>());
  }
  return table;
}

// What it takes to fuse frames in the tree itself: beam by beam, by the thesis's sum, blurring.
Table updates(const Input& input) {
  const ByStep<double> model = model_of_a_lux();
  const auto values = indexes(model, kDefaultEpsilon, Quantisation::kBlurring);
  Table table("quadtree_updates", {"scene", "frame", "changing_updates", "splits", "merges",
                                   "leaves", "differing_cells"});
  TreeFusion fusion;
  for (const char* scene : kScenes) {
    for_each_frame(scene, input, kFramesApart,
                   [&](const FrameEvidence& evidence, std::uint32_t frame) {
                     const TreeUpdates counted = fusion.fuse(evidence, values);
                     table.row(scene, frame, counted.updates, counted.splits, counted.merges,
                               counted.leaves, counted.differing_cells);
                   });
  }
  return table;
}

}  // namespace

Tables quadtree(const Input& input) { return {compactness(input), sizes(input), updates(input)}; }

}  // namespace iog::lab
