// Where hits_win pays for losing no hit: false echoes that the sensor does not flag, ghosts, and
// narrow gaps.
#include "grid/frame_fusion.hpp"
#include "lab/experiments/price_tables.hpp"
#include "lab/experiments/sections.hpp"

namespace iog::lab {

std::vector<std::string> columns_before_fusions(std::vector<std::string> columns) {
  for (const IndexFusion& fusion : kPricedFusions) {
    columns.push_back(name_of(fusion));
  }
  return columns;
}

std::vector<std::size_t> cells_within(double x_low, double x_high, double y_low, double y_high) {
  const auto cell_of = [](double metres) {
    constexpr double kCellM = vehicle::kCellMm / 1000.0;
    constexpr double kHalf = 0.5;
    return static_cast<std::size_t>(metres / kCellM + vehicle::kOriginCell + kHalf);
  };
  std::vector<std::size_t> cells;
  for (std::size_t y = cell_of(y_low); y < cell_of(y_high); ++y) {
    for (std::size_t x = cell_of(x_low); x < cell_of(x_high); ++x) {
      cells.push_back(y * grid::kStride + x);
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

Section price_of_hits_win(const TablesInput& input) {
  Section section;
  section.body.heading("What hits_win pays");
  section.body.paragraph(
      "Under hits_win an echo outvotes every beam that passes through its cell. That is right of "
      "an obstacle and wrong of an echo that nothing solid sent. Three such cases, measured, with "
      "hits_win under both quantisations and the sum in both orders; each frame starts from "
      "nothing.");
  describe_rain(input, section);
  describe_ghosts(input, section);
  describe_gaps(input, section);
  return section;
}

}  // namespace iog::lab
