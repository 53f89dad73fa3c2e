#include "grid/block_shapes.hpp"

namespace iog::grid {
namespace {

constexpr std::uint32_t kSideCells = kBlockSide;

// A line that rises out of the lower block in column u enters the upper block from below in that
// column. So the bits of later columns belong to the upper block.
constexpr std::array<BlockColumn, 64> make_block_columns() {
  std::array<BlockColumn, 64> columns{};
  for (std::uint32_t i = 0; i < columns.size(); ++i) {
    std::uint32_t v = i / 16;
    std::array<std::uint32_t, 2> shapes{shape_of(v, 0)};
    std::uint32_t first_u = 0;
    for (std::uint32_t u = 0; u < kSideCells; ++u) {
      if ((i >> (kSideCells - 1 - u) & 1U) != 0) {
        shapes[v / kSideCells] |= 1U << (u - first_u);
        if (++v == kSideCells) {
          shapes[1] = shape_of(entered_from_below(u), 0);
          first_u = u;
        }
      }
    }
    const bool is_in_upper = v >= kSideCells;
    columns[i] = {{static_cast<BlockCode>(2 * shapes[0] + (is_in_upper ? 1 : 0)),
                   static_cast<BlockCode>(2 * shapes[1])},
                  static_cast<std::uint8_t>(is_in_upper ? 2 : 1),
                  static_cast<std::uint8_t>(v % kSideCells)};
  }
  return columns;
}

// A line runs towards plus u and plus v only. So the cells that can come after a cell are those
// that are not before it on either axis.
constexpr BlockMasks make_block_masks(const Orientation& orientation) {
  BlockMasks masks;
  for (std::uint32_t shape = 0; shape < kShapeCount; ++shape) {
    const BlockEntry entry = shape >> 4;
    std::uint32_t u = entry < kSideCells ? 0 : entry - (kSideCells - 1);
    std::uint32_t v = entry < kSideCells ? entry : 0;
    for (std::uint32_t bits = shape & 15U; u < kSideCells && v < kSideCells; bits >>= 1, ++u) {
      masks.of_shape[shape].bytes[orientation.inner(u, v)] = -1;
      v += bits & 1U;
      if (v < kSideCells) {
        masks.of_shape[shape].bytes[orientation.inner(u, v)] = -1;
      }
    }
  }
  for (std::uint32_t cell = 0; cell < kLaneCount; ++cell) {
    const std::uint32_t place = orientation.inner(cell % kSideCells, cell / kSideCells);
    for (std::uint32_t later = cell; later < kLaneCount; ++later) {
      if (later % kSideCells >= cell % kSideCells) {
        masks.from[place].bytes[orientation.inner(later % kSideCells, later / kSideCells)] = -1;
      }
    }
    masks.after[place] = masks.from[place];
    masks.after[place].bytes[place] = 0;
  }
  return masks;
}

constexpr std::array<BlockMasks, 8> make_all_block_masks() {
  std::array<BlockMasks, 8> masks;
  for (std::size_t number = 0; number < masks.size(); ++number) {
    masks[number] = make_block_masks(Orientation::of(number));
  }
  return masks;
}

}  // namespace

constexpr std::array<BlockColumn, 64> kBlockColumns = make_block_columns();
constexpr std::array<BlockMasks, 8> kBlockMasks = make_all_block_masks();

}  // namespace iog::grid
