// Where hits_win pays for losing no hit: false echoes that the sensor does not flag, ghosts, and
// narrow gaps.
#include "grid/frame_fusion.hpp"
#include "lab/experiments/experiments.hpp"
#include "lab/experiments/price_of_hits_win/priced_fusions.hpp"

namespace iog::lab {

std::vector<std::size_t> cells_within(double x_low, double x_high, double y_low, double y_high) {
  const auto cell_of = [](double metres) {
    constexpr double kCellM = geometry::kCellMm / 1000.0;
    constexpr double kHalf = 0.5;
    return static_cast<std::size_t>(metres / kCellM + geometry::kOriginCell + kHalf);
  };
  std::vector<std::size_t> cells;
  for (std::size_t y = cell_of(y_low); y < cell_of(y_high); ++y) {
    for (std::size_t x = cell_of(x_low); x < cell_of(x_high); ++x) {
      cells.push_back(y * geometry::kCellsPerSide + x);
    }
  }
  return cells;
}

std::vector<std::int32_t> fused_cells(const FrameEvidence& evidence, const IndexFusion& fusion,
                                      const std::vector<std::size_t>& cells) {
  const ByStep<double> model = probabilities(model_of(tools::find_vehicle(tools::kDefaultVehicle)));
  const std::vector<std::int32_t> grid = fuse_indexes(
      evidence, indexes(model, fusion.epsilon, fusion.policy), fusion.rule, fusion.limit);
  std::vector<std::int32_t> some;
  some.reserve(cells.size());
  for (const std::size_t cell : cells) {
    some.push_back(grid[cell]);
  }
  return some;
}

Tables price_of_hits_win(const Input& input) {
  return {price_of_rain(input), price_of_ghosts(input), price_of_gaps(input)};
}

}  // namespace iog::lab
