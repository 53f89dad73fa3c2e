// Four cells at a time, as bytes of a word: most of a tile is flat, and a word without a difference
// costs a comparison.
#include "tile_coding/cell_map.hpp"

#include "tile_coding/palette.hpp"
#include "wire/byte_order.hpp"

namespace iog::tile_coding {
namespace {

constexpr std::size_t kWordCells = 4;
constexpr std::size_t kRowWords = kTileSide / kWordCells;

std::uint32_t word_of(TileCells cells, std::size_t word) {
  return wire::load_le32(cells.subspan(word * kWordCells).first<kWordCells>());
}

// Bit i of the result: byte i is not 0. Adding 0x7F carries into the highest bit of every byte that
// has one of its other bits set, and never beyond; the product brings the four to bits 24 to 27,
// its other terms lie apart from each other.
constexpr std::uint32_t bytes_that_are_not_zero(std::uint32_t word) {
  const std::uint32_t highest = (((word & 0x7F7F7F7FU) + 0x7F7F7F7FU) | word) & 0x80808080U;
  return (((highest >> 7) * 0x01020408U) >> 24) & 0xFU;
}
static_assert(bytes_that_are_not_zero(0x80000100) == 0b1010);
static_assert(bytes_that_are_not_zero(0x00FF0001) == 0b0101);

// Of a row from another one.
std::uint32_t differences(TileCells cells, std::size_t row, TileCells others,
                          std::size_t other_row) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < kRowWords; ++i) {
    const std::uint32_t difference =
        word_of(cells, row * kRowWords + i) ^ word_of(others, other_row * kRowWords + i);
    if (difference != 0) {
      bits |= bytes_that_are_not_zero(difference) << (kWordCells * i);
    }
  }
  return bits;
}

}  // namespace

void CellMap::mark_changes(TileCells cells) {
  std::uint32_t before = std::to_integer<std::uint32_t>(cells[0]);
  for (std::size_t row = 0; row < kTileSide; ++row) {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < kRowWords; ++i) {
      const std::uint32_t word = word_of(cells, row * kRowWords + i);
      const std::uint32_t difference = word ^ (word << 8 | before);
      before = word >> 24;
      if (difference != 0) {
        bits |= bytes_that_are_not_zero(difference) << (kWordCells * i);
      }
    }
    rows_[row] = bits;
  }
}

void CellMap::mark_steps(TileCells cells) {
  rows_[0] = 0;
  for (std::size_t row = 1; row < kTileSide; ++row) {
    rows_[row] = differences(cells, row, cells, row - 1);
  }
}

void CellMap::mark_differences(TileCells cells, TileCells others) {
  for (std::size_t row = 0; row < kTileSide; ++row) {
    rows_[row] = differences(cells, row, others, row);
  }
}

Parts CellMap::parts() const {
  Parts parts;
  std::size_t begin = 0;
  const auto end_at = [&](std::size_t end) {
    ++parts.count;
    parts.log2_sum += bit_width(end - begin) - 1;
    begin = end;
  };
  for_each(end_at);
  end_at(kTileBytes);
  return parts;
}

}  // namespace iog::tile_coding
