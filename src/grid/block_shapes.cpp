#include "grid/block_shapes.hpp"

namespace iog::grid {
namespace {

// How a line leaves a block of some shape.
struct BlockPassage {
  BlockEntry next_entry = 0;
  BlockCode code = 0;

  [[nodiscard]] constexpr bool leaves_above() const { return (code & 1U) != 0; }
};

// Follows the line of a shape through its block and calls visit(u, v) for each cell.
template <typename Visit>
constexpr BlockPassage follow(std::uint32_t shape, Visit&& visit) {
  const BlockEntry entry = shape >> 4;
  const std::uint32_t start_u = entry < 4 ? 0 : entry - 3;
  std::uint32_t v = entry < 4 ? entry : 0;
  std::uint32_t bits_used = 0;
  for (std::uint32_t u = start_u; u < 4; ++u) {
    visit(u, v);
    const std::uint32_t bit = shape & 1U << (u - start_u);
    if (bit != 0) {
      bits_used |= bit;
      ++v;
      if (v == 4) {
        return {entered_from_below(u), static_cast<BlockCode>(2 * shape_of(entry, bits_used) + 1)};
      }
      visit(u, v);
    }
  }
  return {entered_from_the_left(v), static_cast<BlockCode>(2 * shape_of(entry, bits_used))};
}

constexpr BlockPassage passage_of(std::uint32_t shape) {
  return follow(shape, [](std::uint32_t, std::uint32_t) {});
}

// A line that enters its second block of a column from below in column u has used its bits up to
// that of u.
constexpr BlockColumn make_block_column(std::uint32_t v, std::uint32_t first_bit_uppermost) {
  std::uint32_t bits = 0;
  for (std::uint32_t u = 0; u < 4; ++u) {
    bits |= (first_bit_uppermost >> (3 - u) & 1U) << u;
  }
  const BlockPassage lower = passage_of(shape_of(entered_from_the_left(v), bits));
  if (!lower.leaves_above()) {
    return {{lower.code}, 1, static_cast<std::uint8_t>(lower.next_entry)};
  }
  const std::uint32_t u = lower.next_entry == 0 ? 0 : lower.next_entry - 3;
  const BlockPassage upper = passage_of(shape_of(lower.next_entry, bits >> u & ~1U));
  return {{lower.code, upper.code}, 2, static_cast<std::uint8_t>(upper.next_entry)};
}

constexpr std::array<BlockColumn, 64> make_block_columns() {
  std::array<BlockColumn, 64> columns{};
  for (std::uint32_t i = 0; i < columns.size(); ++i) {
    columns[i] = make_block_column(i >> 4, i & 15U);
  }
  return columns;
}

constexpr Orientation orientation_of(std::size_t number) {
  return {.is_steep = (number & 4U) != 0,
          .x_is_negative = (number & 1U) != 0,
          .y_is_negative = (number & 2U) != 0};
}

constexpr std::array<ShapeMasks, 8> make_shape_masks() {
  std::array<ShapeMasks, 8> masks{};
  for (std::size_t number = 0; number < masks.size(); ++number) {
    for (std::uint32_t shape = 0; shape < kShapeCount; ++shape) {
      follow(shape, [&](std::uint32_t u, std::uint32_t v) {
        masks[number][shape].bytes[orientation_of(number).inner(u, v)] = -1;
      });
    }
  }
  return masks;
}

// A line runs towards plus u and plus v only. So the cells that can still come after a cell are
// those that are not before it on either axis.
constexpr std::array<InnerMasks, 4> make_inner_masks(bool with_itself) {
  std::array<InnerMasks, 4> masks{};
  for (std::size_t quadrant = 0; quadrant < masks.size(); ++quadrant) {
    const Orientation orientation = orientation_of(quadrant);
    for (std::uint32_t cell = 0; cell < kLaneCount; ++cell) {
      const std::uint32_t u = cell % 4;
      const std::uint32_t v = cell / 4;
      LaneBytes& mask = masks[quadrant][orientation.inner(u, v)];
      for (std::uint32_t later_u = u; later_u < 4; ++later_u) {
        for (std::uint32_t later_v = v; later_v < 4; ++later_v) {
          const bool is_itself = later_u == u && later_v == v;
          mask.bytes[orientation.inner(later_u, later_v)] = is_itself && !with_itself ? 0 : -1;
        }
      }
    }
  }
  return masks;
}

}  // namespace

constexpr std::array<BlockColumn, 64> kBlockColumns = make_block_columns();
constexpr std::array<ShapeMasks, 8> kShapeMasks = make_shape_masks();
constexpr std::array<InnerMasks, 4> kFromMasks = make_inner_masks(true);
constexpr std::array<InnerMasks, 4> kAfterMasks = make_inner_masks(false);

}  // namespace iog::grid
