// Walks along a line cell by cell, using integer arithmetic. This loop is the innermost loop of the
// entire computation (docs/model.md section 5).
//
// As in appendix B.3 of the thesis, a step crosses a column border (c_x), a row border (c_y), or
// both at a corner (c_xy). The code differs from the algorithms in the thesis in two ways. First,
// the code corrects the initial value of the error term in algorithm 4. Second, the number of
// borders after which the walk ends is known before the first step. The walk in the thesis ends
// when it reaches the end cell, but a line that ends on a corner never enters that cell.
//
// Error term: e = (distance to the next column border) * w_y - (distance to the next row border) *
// w_x. A column step adds r * w_y, and a row step subtracts r * w_x. The line passes through the
// cell, so e always stays within +- r * (w_x + w_y), which is below 2^31.
#pragma once

#include <cstddef>
#include <cstdint>

#include "traversal/line.hpp"

namespace iog::traversal {

// Walks along a line on a grid that is stored row by row. `stride` is the distance in cells from
// one row to the next. A cell is identified by its offset from the first cell of the grid. If the
// caller stays within the part returned by Line::clip(), the visitor never receives an offset
// outside the grid.
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

  // Visits cells, starting with the current one, as long as fewer than `end` borders have been
  // crossed. The next call continues with the cell after the last visited one. `visit` receives the
  // offset of each cell.
  template <typename Visit>
  void until(std::uint32_t end, Visit&& visit) {
    while (crossed_ < end) {
      visit(static_cast<std::size_t>(offset_));
      step();
    }
  }

  // Advances like until(), but without visiting cells.
  void skip_until(std::uint32_t end) {
    while (crossed_ < end) {
      step();
    }
  }

 private:
  // At a corner, the error term is 0 and both borders are crossed in one step.
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
