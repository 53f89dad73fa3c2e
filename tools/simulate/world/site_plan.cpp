#include "tools/simulate/world/site_plan.hpp"

#include <cmath>

namespace iog::tools {

std::vector<Placement> line_beside(const Road& road, double from, double to, double left) {
  constexpr double kPieceM = 2.0;
  const auto pieces = static_cast<int>(std::ceil((to - from) / kPieceM));
  std::vector<Placement> line;
  for (int i = 0; i <= pieces; ++i) {
    line.push_back(road.at(from + (to - from) * i / pieces, left));
  }
  return line;
}

PlannedHouse house_of(const Solid& box) { return {box.at, box.half_length, box.half_width}; }

}  // namespace iog::tools
