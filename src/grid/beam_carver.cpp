#include "grid/beam_carver.hpp"

#include "grid/carving.hpp"

namespace iog::grid {

// The end of a beam without a hit on its line. If the echo lies beyond the line, this is the line's
// end. Without an echo the beam carves up to clears_mm.
Between BeamCarver::end_without_hit(const vehicle::Sensor& sensor, const KeptLine& line,
                                    std::uint32_t clears_mm, std::uint32_t range_mm) {
  const std::uint32_t length_mm = sensor.range.mm();
  return range_mm == 0 && clears_mm < length_mm
             ? Between::after(line.line().before({clears_mm, length_mm}))
             : line.in_grid().end;
}

template <typename Steps>
void BeamCarver::carve(KeptLine& line, BlockGrid& grid, Steps& steps) {
  if (line.has_path()) {
    carve_blocks(grid, line.path(grid), steps);
  } else {
    carve_cells(grid, line.line(), line.in_grid().first.at(), steps);
  }
}

void BeamCarver::carve(KeptLine& line, LineSteps& steps) {
  carve(line, grids_->indexes, steps.free);
  if (!steps.low.is_empty()) {
    carve(line, grids_->heights, steps.low);
  }
}

}  // namespace iog::grid
