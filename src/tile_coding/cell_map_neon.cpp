// A row of cells is two registers. A comparison turns each byte into all ones or all zeros. Of each
// byte one bit is kept, a different one in each of eight neighbours. Three pairwise additions then
// gather the 32 bits of a row; the last addition does so for two rows at once.
#include <arm_neon.h>

#include "tile_coding/cell_map.hpp"

namespace iog::tile_coding {
namespace {

struct Row {
  uint8x16_t left;
  uint8x16_t right;
};

Row row_of(TileCells cells, std::size_t y) {
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&cells[y * kTileSide]);
  return {vld1q_u8(bytes), vld1q_u8(bytes + 16)};
}

// The row moved up by one cell: in each place the cell before it. The last byte of `before` is the
// cell before the first.
Row shifted(const Row& row, uint8x16_t before) {
  return {vextq_u8(before, row.left, 15), vextq_u8(row.left, row.right, 15)};
}

uint8x8_t kept_bits(uint8x16_t a, uint8x16_t b) {
  constexpr std::uint64_t kOneOfEach = 0x8040201008040201;
  const uint8x16_t one_of_each = vreinterpretq_u8_u64(vdupq_n_u64(kOneOfEach));
  const uint8x16_t kept = vbicq_u8(one_of_each, vceqq_u8(a, b));
  return vpadd_u8(vget_low_u8(kept), vget_high_u8(kept));
}

// Of each cell, whether it differs: four cells a byte.
uint8x8_t differences(const Row& a, const Row& b) {
  return vpadd_u8(kept_bits(a.left, b.left), kept_bits(a.right, b.right));
}

void store_rows(uint8x8_t first, uint8x8_t second, std::uint32_t* bits) {
  vst1_u32(bits, vreinterpret_u32_u8(vpadd_u8(first, second)));
}

}  // namespace

void CellMap::mark_changes(TileCells cells) {
  uint8x16_t before = vdupq_n_u8(std::to_integer<std::uint8_t>(cells[0]));
  for (std::size_t y = 0; y < kTileSide; y += 2) {
    const Row first = row_of(cells, y);
    const Row second = row_of(cells, y + 1);
    store_rows(differences(first, shifted(first, before)),
               differences(second, shifted(second, first.right)), &rows_[y]);
    before = second.right;
  }
}

void CellMap::mark_steps(TileCells cells) {
  Row below = row_of(cells, 0);
  for (std::size_t y = 0; y < kTileSide; y += 2) {
    const Row first = row_of(cells, y);
    const Row second = row_of(cells, y + 1);
    store_rows(differences(first, below), differences(second, first), &rows_[y]);
    below = second;
  }
}

// Row by row, because the other tile is seldom in the cache: while one cache line of it is awaited,
// the next is already asked for.
void CellMap::mark_differences(TileCells cells, TileCells others) {
  for (std::size_t y = 0; y < kTileSide; ++y) {
    const uint8x8_t fours = differences(row_of(cells, y), row_of(others, y));
    vst1_lane_u32(&rows_[y], vreinterpret_u32_u8(vpadd_u8(fours, fours)), 0);
  }
}

}  // namespace iog::tile_coding
