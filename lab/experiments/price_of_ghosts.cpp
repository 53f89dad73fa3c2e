// What a ghost that one scanner sees does to grids of one frame and of several.
#include <algorithm>
#include <array>

#include "lab/experiments/false_echoes.hpp"
#include "lab/experiments/price_tables.hpp"

namespace iog::lab {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr std::uint64_t kGhostStream = 82;  // of the seed's random numbers
constexpr std::uint32_t kGhostFrames = 20;
constexpr std::array<std::uint32_t, 4> kGhostPeriods{1, 2, 4, 10};
constexpr double kGhostX = 8;
constexpr double kGhostHalfWidth = 0.5;

// The indexes of some cells after a frame.
using Indexes = std::vector<std::int32_t>;

std::size_t occupied_in(const Indexes& indexes) {
  return static_cast<std::size_t>(
      std::count_if(indexes.begin(), indexes.end(), [](std::int32_t index) { return index > 0; }));
}

// The ghost's surroundings in every frame, without and with it.
struct GhostFrames {
  std::array<std::vector<Indexes>, 2> frames;
};

ByFusion<GhostFrames> see_ghost(std::uint64_t seed) {
  const tools::CatalogueEntry& car = tools::find_vehicle(tools::kDefaultVehicle);
  const Ghost ghost{.sensor = tools::sensor_of_name(car, "front_centre"),
                    .x_m = kGhostX,
                    .half_width_m = kGhostHalfWidth};
  const std::vector<tools::Solid> street{
      box(tools::Material::kWall, {.x = 30.5, .y = 0}, 1, 60, 0, 3)};
  const auto around = cells_within(kGhostX - 1, kGhostX + 1, -1, 1);
  StandingCar standing(car);
  tools::Random random(seed, kGhostStream);
  ByFusion<GhostFrames> seen;
  for (std::uint32_t frame = 0; frame < kGhostFrames; ++frame) {
    const FramePoints clean = standing.look_at(street, random);
    const std::array views{clean, with_ghost(clean, car, ghost, random)};
    for (std::size_t view = 0; view < views.size(); ++view) {
      const FrameEvidence evidence = project(*car.vehicle, views[view], {});
      for (std::size_t i = 0; i < kPricedFusions.size(); ++i) {
        seen[i].frames[view].push_back(fused_cells(evidence, kPricedFusions[i], around));
      }
    }
  }
  return seen;
}

// Wrongly occupied cells a frame with the ghost in one frame of `period`: in grids of one frame,
// and in one that adds them up.
struct GhostCells {
  double in_frames = 0;
  double in_sum = 0;
};

GhostCells count_ghost(const GhostFrames& seen, std::uint32_t period) {
  Indexes sum(seen.frames[0][0].size(), 0);
  std::size_t in_frames = 0;
  std::size_t in_sum = 0;
  for (std::uint32_t frame = 0; frame < kGhostFrames; ++frame) {
    const Indexes& now = seen.frames[frame % period == 0 ? 1 : 0][frame];
    for (std::size_t cell = 0; cell < sum.size(); ++cell) {
      sum[cell] = std::clamp(sum[cell] + now[cell], -kInt8Limit, kInt8Limit);
    }
    in_frames += occupied_in(now);
    in_sum += occupied_in(sum);
  }
  return {static_cast<double>(in_frames) / kGhostFrames,
          static_cast<double>(in_sum) / kGhostFrames};
}

}  // namespace

void describe_ghosts(const TablesInput& input, Section& section) {
  Markdown& body = section.body;
  const ByFusion<GhostFrames> seen = see_ghost(input.seed);
  body.subheading("A ghost that one of three sensors sees");
  body.paragraph(
      "A standing car before a wall 30 m away. In one frame of N, of " +
      std::to_string(kGhostFrames) +
      ", the scanner in the middle sees a plate 1 m wide 8 m ahead that is not there, and not what "
      "is behind it; the two beside it look through. Wrongly occupied cells there, mean of a "
      "frame: in grids of one frame each, and in one that adds whole frames index by index, "
      "saturating at 127.");
  Rows rows;
  for (const std::uint32_t period : kGhostPeriods) {
    std::vector<std::string> in_sum{std::to_string(period), "added up"};
    rows.push_back({std::to_string(period), "one frame"});
    for (const GhostFrames& frames : seen) {
      const GhostCells cells = count_ghost(frames, period);
      rows.back().push_back(fixed(cells.in_frames, 2));
      in_sum.push_back(fixed(cells.in_sum, 2));
    }
    rows.push_back(in_sum);
  }
  body.table(columns_before_fusions({"N", "grid"}), rows);
  const GhostCells always = count_ghost(seen[kHitsWinPlace], 1);
  const GhostCells rarely = count_ghost(seen[kHitsWinPlace], kGhostPeriods.back());
  body.paragraph(
      "In a grid of one frame hits_win shows the ghost whenever it is there, " +
      fixed(always.in_frames, 1) +
      " cells of it; the sum does not, as long as others look through the same place. In a grid "
      "that adds frames a ghost that comes and goes is seen only until the first clean frame, here "
      "in the first of " +
      std::to_string(kGhostFrames) + " (" + fixed(rarely.in_sum * kGhostFrames, 0) +
      " cells): its few hits come up against all the carving of the frames between. A ghost that "
      "never goes stays under hits_win, like any object that only one sensor can see; which of the "
      "two it is no grid can tell.");
}

}  // namespace iog::lab
