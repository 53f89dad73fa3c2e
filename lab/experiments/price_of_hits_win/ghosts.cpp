// What a ghost that one scanner sees does to grids of one frame and of several.
#include <algorithm>
#include <array>
#include <string>

#include "lab/experiments/price_of_hits_win/false_echoes.hpp"
#include "lab/experiments/price_of_hits_win/priced_fusions.hpp"

namespace iog::lab {
namespace {

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

// Wrongly occupied cells of every frame with the ghost in one frame of `period`: in a grid of that
// frame alone, and in one that adds up all frames until then.
void count_ghost(const GhostFrames& seen, std::uint32_t period, const std::string& fusion,
                 Table& table) {
  Indexes sum(seen.frames[0][0].size(), 0);
  for (std::uint32_t frame = 0; frame < kGhostFrames; ++frame) {
    const Indexes& now = seen.frames[frame % period == 0 ? 1 : 0][frame];
    for (std::size_t cell = 0; cell < sum.size(); ++cell) {
      sum[cell] = std::clamp(sum[cell] + now[cell], -kInt8Limit, kInt8Limit);
    }
    table.row(period, fusion, frame, occupied_in(now), occupied_in(sum));
  }
}

}  // namespace

Table price_of_ghosts(const Input& input) {
  const ByFusion<GhostFrames> seen = see_ghost(input.seed);
  Table table("price_of_ghosts",
              {"period_frames", "fusion", "frame", "occupied_cells", "occupied_cells_of_sum"});
  for (const std::uint32_t period : kGhostPeriods) {
    for (std::size_t i = 0; i < kPricedFusions.size(); ++i) {
      count_ghost(seen[i], period, name_of(kPricedFusions[i]), table);
    }
  }
  return table;
}

}  // namespace iog::lab
