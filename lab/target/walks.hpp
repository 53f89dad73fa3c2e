// Four ways from a beam's start to its end, cell by cell, to be compared by their cost. Each is set
// up from the end of a beam that starts in the grid's south-west corner, and visits the cell that
// holds the start, the cell that holds the end, and what it takes for the cells between them, by
// their offset in a grid of kFanStride cells a row.
//
// The product's walk and its line serve every direction. The others are set up for beams to the
// north-east alone, which makes their set-up cheaper than it would be; their steps are variables
// nevertheless, so that going from cell to cell costs what it costs in any direction. They visit
// the cells that the walks of lab/reference/traversal.hpp visit, which are written to be read and
// not to be timed.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "fan.hpp"
#include "traversal/walk.hpp"

namespace iog::lab {

// The product's: src/traversal, with r subcells per cell side.
template <std::int32_t kResolution>
class DiscreteWalk {
 public:
  using End = geometry::SubcellPoint;
  static End end_of(BeamEnd end) {
    return {in_parts(end.x, kResolution), in_parts(end.y, kResolution)};
  }

  explicit DiscreteWalk(End end) : DiscreteWalk(traversal::Line<kResolution>({}, end)) {}

  template <typename Visit>
  void run(Visit&& visit) {
    walk_.until(end_, visit);
  }

 private:
  explicit DiscreteWalk(const traversal::Line<kResolution>& line)
      : walk_(line, {}, kFanStride), end_(line.through(kReachMm, kLength).crossed() + 1) {}

  static constexpr std::uint32_t kReachMm = 50'000;
  static constexpr traversal::LineLength kLength{kReachMm};

  traversal::Walk walk_;
  std::uint32_t end_;
};

// Algorithm 3 of the thesis as printed: location and error are real numbers. Lengths are in cells,
// so that a location, which is compared for equality, has no rounding error. It ends where it meets
// the end cell; beams of the fan do, which not every line does (docs/model.md section 5).
template <std::floating_point Real>
class ContinuousWalk {
 public:
  struct End {
    Real x;
    Real y;
  };
  static End end_of(BeamEnd end) {
    return {static_cast<Real>(in_cells(end.x)), static_cast<Real>(in_cells(end.y))};
  }

  explicit ContinuousWalk(End end)
      : end_x_(static_cast<Real>(static_cast<std::int32_t>(end.x))),
        end_y_(static_cast<Real>(static_cast<std::int32_t>(end.y))),
        loss_(step_x_ * end.y),
        gain_(step_y_ * end.x),
        error_(gain_ - loss_) {}

  template <typename Visit>
  void run(Visit&& visit) {
    visit(offset());
    while (x_ != end_x_ || y_ != end_y_) {
      if (error_ == 0) {
        x_ += step_x_;
        y_ += step_y_;
        error_ += gain_ - loss_;
      } else if (error_ > 0) {
        x_ += step_x_;
        error_ -= loss_;
      } else {
        y_ += step_y_;
        error_ += gain_;
      }
      visit(offset());
    }
  }

 private:
  [[nodiscard]] std::size_t offset() const {
    const std::int32_t place =
        static_cast<std::int32_t>(y_) * kFanStride + static_cast<std::int32_t>(x_);
    return static_cast<std::size_t>(place);
  }

  Real x_ = 0;
  Real y_ = 0;
  Real step_x_ = 1;
  Real step_y_ = 1;
  Real end_x_;
  Real end_y_;
  Real loss_;
  Real gain_;
  Real error_;
};

// The same steps with nothing but the error in floating point: where it stands is an offset and a
// count, as in the product. What is left of the difference is the arithmetic's own.
template <std::floating_point Real>
class RealErrorWalk {
 public:
  using End = typename ContinuousWalk<Real>::End;
  static End end_of(BeamEnd end) { return ContinuousWalk<Real>::end_of(end); }

  explicit RealErrorWalk(End end)
      : rest_(static_cast<std::int32_t>(end.x) + static_cast<std::int32_t>(end.y)),
        loss_(end.y),
        gain_(end.x),
        error_(gain_ - loss_) {}

  template <typename Visit>
  void run(Visit&& visit) {
    while (rest_ >= 0) {
      visit(static_cast<std::size_t>(offset_));
      const Real error = error_;
      if (error >= 0) {
        error_ -= loss_;
        offset_ += step_x_;
        --rest_;
      }
      if (error <= 0) {
        error_ += gain_;
        offset_ += step_y_;
        --rest_;
      }
    }
  }

 private:
  std::int32_t rest_;  // borders still to cross
  std::int32_t offset_ = 0;
  std::int32_t step_x_ = 1;
  std::int32_t step_y_ = kFanStride;
  Real loss_;
  Real gain_;
  Real error_;
};

// Bresenham's line between the cells that hold start and end: one cell per step of the longer axis,
// of two equally near ones the further one.
class BresenhamWalk {
 public:
  using End = geometry::Cell;
  static End end_of(BeamEnd end) {
    return {static_cast<std::int32_t>(in_cells(end.x)), static_cast<std::int32_t>(in_cells(end.y))};
  }

  explicit BresenhamWalk(End end)
      : longer_(std::max(end.x, end.y)),
        shorter_(std::min(end.x, end.y)),
        along_(end.x >= end.y ? 1 : kFanStride),
        aside_(end.x >= end.y ? kFanStride : 1),
        error_((longer_ - 1) / 2) {}

  template <typename Visit>
  void run(Visit&& visit) {
    for (std::int32_t rest = longer_; rest >= 0; --rest) {
      visit(static_cast<std::size_t>(offset_));
      offset_ += along_;
      error_ -= shorter_;
      if (error_ < 0) {
        offset_ += aside_;
        error_ += longer_;
      }
    }
  }

 private:
  std::int32_t longer_;
  std::int32_t shorter_;
  std::int32_t along_;
  std::int32_t aside_;
  std::int32_t error_;
  std::int32_t offset_ = 0;
};

}  // namespace iog::lab
