// An edge from L to H, with L below, crosses the row whose centres are at y at
//     x = Lx + (y - Ly) dx / dy.
// The first centre at or to the right of it is in column
//     c = ceil((x - kFine/2) / kFine) = ceil(N / (kFine dy)),  N = (Lx - kFine/2) dy + (y - Ly) dx.
// That equals ceil(M / dy) with M = ceil(N / kFine), because dy is an integer. From row to row N
// grows by kFine dx, so M grows by exactly dx. One division gives the column of the first row, and
// one the step, as in Bresenham's line algorithm.
//
// Widths: coordinates and differences are below 2^30.2 (map/tile_place.cpp), so N is below 2^61.4
// and M below 2^53.4. A column belongs to a point between the ends. The step of an edge that
// crosses two rows is a difference of two columns. Both are below 2^24, so the biased quotients are
// not negative and below 2^25, and the biased dividends below 2^54.9.
#include "map/raster.hpp"

#include <cstddef>
#include <utility>

#include "numeric/divisor.hpp"

namespace iog::map {
namespace {

constexpr std::int32_t kHalf = kFine / 2;

// The cells of a column and of all columns to its right.
constexpr auto kCellsFrom = [] {
  std::array<std::uint64_t, kFrameSide + 1> cells{};
  for (std::size_t column = 0; column < kFrameSide; ++column) {
    cells[column] = ~std::uint64_t{0} << column;
  }
  return cells;
}();

std::uint64_t cells_from(std::int32_t column) {
  return kCellsFrom[static_cast<std::size_t>(std::clamp<std::int32_t>(column, 0, kFrameSide))];
}

// dividend = quotient * divisor - rest, 0 <= rest < divisor.
struct CeilDivision {
  std::int32_t quotient;
  std::uint32_t rest;
};

// The quotient is within +-2^24. A bias makes it positive, so it is rounded down for both signs.
// The rest is exact in the lower words.
CeilDivision divided(std::int64_t dividend, std::uint32_t divisor, const numeric::Divisor& by) {
  constexpr std::uint32_t kBias = 1U << 24;
  const std::int64_t biased = dividend + (std::int64_t{divisor} * kBias + (divisor - 1));
  const std::uint32_t quotient = by.divide(static_cast<std::uint64_t>(biased)) - kBias;
  return {static_cast<std::int32_t>(quotient),
          quotient * divisor - static_cast<std::uint32_t>(dividend)};
}

// Most edges are steeper than the diagonal: they step by one column or none from row to row.
CeilDivision step_of(std::int32_t dx, std::uint32_t dy, const numeric::Divisor& by_dy) {
  const auto size = static_cast<std::uint32_t>(dx < 0 ? -dx : dx);
  if (size < dy) {
    return dx > 0 ? CeilDivision{1, dy - size} : CeilDivision{0, size};
  }
  return divided(dx, dy, by_dy);
}

}  // namespace

void Raster::clear(RowRange rows) {
  wanted_ = rows;
  touched_ = {kFrameSide, 0};
  odd_ = {};
}

void Raster::add_edge(RowRange rows, FinePoint from, FinePoint to) {
  if (first_from(std::min(from.x, to.x)) >= wanted_.end) {
    return;
  }
  touched_ = {std::min(touched_.first, rows.first), std::max(touched_.end, rows.end)};
  if (first_from(std::max(from.x, to.x)) <= wanted_.first) {
    toggle(rows, ~std::uint64_t{0});
  } else if (from.y < to.y) {
    cross(rows, from, to);
  } else {
    cross(rows, to, from);
  }
}

void Raster::toggle(RowRange rows, std::uint64_t cells) {
  for (std::int32_t row = rows.first; row < rows.end; ++row) {
    odd_.rows[static_cast<std::size_t>(row)] ^= cells;
  }
}

void Raster::cross(RowRange rows, FinePoint low, FinePoint high) {
  const std::int32_t dx = high.x - low.x;
  const std::int32_t dy = high.y - low.y;
  const auto divisor = static_cast<std::uint32_t>(dy);
  const numeric::Divisor by_dy(divisor);
  const std::int32_t above = rows.first * kFine + kHalf - low.y;
  const std::int64_t scaled = std::int64_t{low.x - kHalf} * dy + std::int64_t{above} * dx;
  auto [column, rest] = divided((scaled + kFine - 1) >> kFineBits, divisor, by_dy);
  std::uint64_t* row = &odd_.rows[static_cast<std::size_t>(rows.first)];
  *row ^= cells_from(column);
  if (rows.first + 1 == rows.end) {
    return;
  }
  const CeilDivision step = step_of(dx, divisor, by_dy);
  for (std::int32_t left = rows.end - rows.first - 1; left > 0; --left) {
    rest += step.rest;
    const bool is_whole = rest >= divisor;
    rest -= is_whole ? divisor : 0;
    column += step.quotient - (is_whole ? 1 : 0);
    ++row;
    *row ^= cells_from(column);
  }
}

void Raster::add_to(FrameBits& bits) {
  for (std::int32_t row = touched_.first; row < touched_.end; ++row) {
    const auto y = static_cast<std::size_t>(row);
    bits.rows[y] |= std::exchange(odd_.rows[y], 0);
  }
  touched_ = {kFrameSide, 0};
}

}  // namespace iog::map
