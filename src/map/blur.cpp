// A disc is handled by columns. The column k cells to the side has this height, which grows as k
// falls:
//     h(k) = floor(sqrt(r^2 - k^2))
// Let V(h) be the union over h rows above and below. Then
//     A(r) = V(h(r)),  A(k) = A(k + 1) widened by one cell on both sides, united with V(h(k))
// leads to A(0), the union over the disc: what is added at k is widened k times. V is extended step
// by step.
#include "map/blur.hpp"

#include <array>
#include <cstddef>
#include <span>

#include "window/rows.hpp"

namespace iog::map {
namespace {

using window::RowPair;

static_assert(kHalo == window::kColumnMargin, "what RowPair takes for the middle");

using Heights = std::array<std::uint8_t, kHalo + 1>;

// The heights of the columns of a disc, by radius.
consteval std::array<Heights, kHalo + 1> heights_of_discs() {
  std::array<Heights, kHalo + 1> discs{};
  for (std::size_t radius = 0; radius < discs.size(); ++radius) {
    for (std::size_t column = 0; column <= radius; ++column) {
      std::uint8_t& height = discs[radius][column];
      const std::size_t most = radius * radius - column * column;
      while ((height + std::size_t{1}) * (height + 1U) <= most) {
        ++height;
      }
    }
  }
  return discs;
}
constexpr std::array<Heights, kHalo + 1> kHeights = heights_of_discs();

window::Plane filled(std::uint32_t row) {
  window::Plane plane;
  plane.fill(row);
  return plane;
}

RowPair wider(RowPair rows) { return rows.bit_or(rows.up<1>()).bit_or(rows.down<1>()); }

// Two rows of the result. `middle`: the same two rows of the source.
RowPair over_disc(const std::uint64_t* middle, std::size_t radius) {
  const Heights& heights = kHeights[radius];
  RowPair tall = RowPair::load(middle);
  RowPair wide = tall;
  std::ptrdiff_t height = 0;
  for (std::size_t column = radius; column > 0; --column) {
    wide = wider(wide);
    while (height < heights[column - 1]) {
      ++height;
      tall = tall.bit_or(RowPair::load(middle + height)).bit_or(RowPair::load(middle - height));
    }
    wide = wide.bit_or(tall);
  }
  return wide;
}

}  // namespace

window::Plane blurred(const FrameBits& bits, std::int32_t radius) {
  const RowRange range = RowRange::around_tile(radius);
  const std::span rows = std::span(bits.rows).subspan(
      static_cast<std::size_t>(range.first), static_cast<std::size_t>(range.end - range.first));
  std::uint64_t any = 0;
  std::uint64_t all = ~std::uint64_t{0};
  for (const std::uint64_t row : rows) {
    any |= row;
    all &= row;
  }
  if (any == 0 || ~all == 0) {
    return filled(static_cast<std::uint32_t>(any));
  }
  window::Plane plane;
  for (std::size_t y = 0; y < plane.size(); y += 2) {
    over_disc(&bits.rows[y + kHalo], static_cast<std::size_t>(radius)).store_middle(&plane[y]);
  }
  return plane;
}

}  // namespace iog::map
