// The walk along a line, cell by cell, in integers: the kernel of the whole computation.
//
// docs/model.md section 5; the three-way step of the thesis's appendix B.3 (c_x, c_y, c_xy), with
// the error initialised to what Algorithm 4 meant, and ended by a count that is known before the
// first step instead of by meeting the end cell, which a line that ends on a corner never does.
//
// Error term. e = (distance to the next column border) * w_y - (distance to the next row border) *
// w_x. A column step adds r * w_y, a row step subtracts r * w_x. The line passes through the cell,
// so the far corner is never further off than |e| <= r * (w_x + w_y) < 2^31.
#pragma once

#include <cstddef>
#include <cstdint>

#include "traversal/line.hpp"

namespace iog::traversal {

// Walks a line over a grid stored row by row, `stride` cells apart. Cells are named by their offset
// from the grid's first cell; an offset outside the grid is never passed to the visitor as long as
// the caller walks within Line::clip().
class Walk {
 public:
  template <std::int32_t kResolution>
  Walk(const Line<kResolution>& line, Position from, std::int32_t stride)
      : crossed_(from.crossed()),
        error_(line.error(from)),
        column_gain_(kResolution * static_cast<std::int32_t>(line.y().length())),
        row_gain_(kResolution * static_cast<std::int32_t>(line.x().length())),
        column_step_(line.x().step()),
        row_step_(line.y().step() * stride),
        offset_(line.cell(from).y * stride + line.cell(from).x) {}

  // Visits the current cell and those after it while fewer than `end` borders are crossed. Further
  // calls go on from there. `visit` takes the offset of a cell.
  template <typename Visit>
  void until(std::uint32_t end, Visit&& visit) {
    while (crossed_ < end) {
      visit(static_cast<std::size_t>(offset_));
      step();
    }
  }

  // Goes on without visiting.
  void skip_until(std::uint32_t end) {
    while (crossed_ < end) {
      step();
    }
  }

 private:
  // A corner is where neither side wins: both borders are crossed in one step.
  void step() {
    const std::int32_t error = error_;
    if (error <= 0) {
      error_ += column_gain_;
      offset_ += column_step_;
      ++crossed_;
    }
    if (error >= 0) {
      error_ -= row_gain_;
      offset_ += row_step_;
      ++crossed_;
    }
  }

  std::uint32_t crossed_;
  std::int32_t error_;
  std::int32_t column_gain_;
  std::int32_t row_gain_;
  std::int32_t column_step_;
  std::int32_t row_step_;
  std::int32_t offset_;
};

}  // namespace iog::traversal
