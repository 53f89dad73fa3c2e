#include "lab/tree/tile_shape.hpp"

#include "wire/byte_order.hpp"

// From cells to blocks, from small to large. Four cells are one word; they are alike if the word is
// the same after a turn by a byte. The leaves of a block are written behind one another as if each
// of its parts were one; if it turns out that its four parts are leaves and alike, their indexes
// are the last four bytes written, and the first of them stands for all.
namespace iog::tree {
namespace {

using Word = std::uint32_t;

Word load(const std::byte* four) { return wire::load_le32(std::span<const std::byte, 4>(four, 4)); }

bool are_alike(Word four) { return four == std::rotr(four, 8); }

// Where the i-th of the four parts of a block begins, each of `side` cells a side.
constexpr std::size_t part_offset(std::size_t i, std::size_t side) {
  return (i >> 1) * side * kTileSide + (i & 1U) * side;
}

// The leaves of a tile, as they are written.
class LeafWriter {
 public:
  explicit LeafWriter(std::byte* first) : next_(first) {}

  [[nodiscard]] const std::byte* next() const { return next_; }

  void add(Word cell) { *next_++ = static_cast<std::byte>(cell); }

  // The leaves of 2 by 2 cells, one or four. Returns whether they are four, as 0 or this bit. To
  // the compiler it is no branch but additions under a condition: nobody can predict where the grid
  // is split.
  Word add_block_2(Word cells, Word bit) {
    wire::store_le32(std::span<std::byte, 4>(next_, 4), cells);
    ++next_;
    if (are_alike(cells)) {
      return 0;
    }
    next_ += 3;
    return bit;
  }

  // Four leaves were written last: makes them one if they are alike. Returns whether they were.
  bool merge_four() {
    if (!are_alike(load(next_ - 4))) {
      return false;
    }
    next_ -= 3;
    return true;
  }

 private:
  std::byte* next_;
};

// Which of the parts of an 8 by 8 block are split: sixteen of 2 by 2, four of 4 by 4.
struct Splits {
  Word of_2 = 0;
  Word of_4 = 0;
};

// The kPart-th of the blocks of 4 by 4. A block whose cells are all alike is one leaf, every other
// is split.
template <unsigned kPart>
void shape_block_4(const std::byte* block_8, LeafWriter& leaves, Splits& splits) {
  const std::byte* const cells = block_8 + part_offset(kPart, 4);
  const Word row_0 = load(cells);
  const Word row_1 = load(cells + kTileSide);
  const Word row_2 = load(cells + 2 * kTileSide);
  const Word row_3 = load(cells + 3 * kTileSide);
  const Word differences =
      (row_0 ^ row_1) | (row_0 ^ row_2) | (row_0 ^ row_3) | (row_0 ^ std::rotr(row_0, 8));
  if (differences == 0) {
    leaves.add(row_0);
    return;
  }
  constexpr Word kLow = 0xFFFFU;
  constexpr Word kFirst = 1U << (4 * kPart);
  splits.of_4 |= 1U << kPart;
  splits.of_2 |= leaves.add_block_2((row_0 & kLow) | row_1 << 16, kFirst);
  splits.of_2 |= leaves.add_block_2(row_0 >> 16 | (row_1 & ~kLow), kFirst << 1);
  splits.of_2 |= leaves.add_block_2((row_2 & kLow) | row_3 << 16, kFirst << 2);
  splits.of_2 |= leaves.add_block_2(row_2 >> 16 | (row_3 & ~kLow), kFirst << 3);
}

// Whether an 8 by 8 block is split. If not, no part of it is.
bool shape_block_8(const std::byte* cells, LeafWriter& leaves, Splits& splits) {
  shape_block_4<0>(cells, leaves, splits);
  shape_block_4<1>(cells, leaves, splits);
  shape_block_4<2>(cells, leaves, splits);
  shape_block_4<3>(cells, leaves, splits);
  return splits.of_4 != 0 || !leaves.merge_four();
}

QuarterShape shape_quarter(const std::byte* cells, LeafWriter& leaves) {
  QuarterShape shape;
  const std::byte* const first = leaves.next();
  for (std::size_t block = 0; block < 4; ++block) {
    Splits splits;
    if (shape_block_8(cells + part_offset(block, 8), leaves, splits)) {
      shape.split_8 = static_cast<std::uint8_t>(shape.split_8 | 1U << block);
      shape.split_4 = static_cast<std::uint16_t>(shape.split_4 | splits.of_4 << (4 * block));
      shape.split_2[block >> 1] |= splits.of_2 << (16 * (block & 1U));
    }
  }
  if (shape.split_8 == 0) {
    leaves.merge_four();
  }
  shape.last_leaf = static_cast<std::uint8_t>(leaves.next() - first - 1);
  return shape;
}

}  // namespace

std::uint32_t shape_tile(TileCells cells, TileShape& shape, TileLeaves leaves) {
  LeafWriter writer(leaves.data());
  bool is_split = false;
  for (std::size_t quarter = 0; quarter < shape.size(); ++quarter) {
    shape[quarter] = shape_quarter(cells.data() + part_offset(quarter, kTileSide / 2), writer);
    is_split = is_split || shape[quarter].last_leaf != 0;
  }
  if (!is_split) {
    writer.merge_four();
  }
  return static_cast<std::uint32_t>(writer.next() - leaves.data());
}

}  // namespace iog::tree
