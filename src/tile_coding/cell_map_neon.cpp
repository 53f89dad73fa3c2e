// A row of cells is two registers. A comparison makes all ones or all zeros of each byte; one bit
// of it is kept, another one in each of eight, and three pairwise additions bring the 32 together.
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

uint8x8_t kept_bits(uint8x16_t a, uint8x16_t b) {
  constexpr std::uint64_t kOneOfEach = 0x8040201008040201;
  const uint8x16_t one_of_each = vreinterpretq_u8_u64(vdupq_n_u64(kOneOfEach));
  const uint8x16_t kept = vbicq_u8(one_of_each, vceqq_u8(a, b));
  return vpadd_u8(vget_low_u8(kept), vget_high_u8(kept));
}

void store_differences(const Row& a, const Row& b, std::uint32_t& bits) {
  const uint8x8_t halves = vpadd_u8(kept_bits(a.left, b.left), kept_bits(a.right, b.right));
  const uint8x8_t all = vpadd_u8(halves, halves);
  vst1_lane_u32(&bits, vreinterpret_u32_u8(all), 0);
}

}  // namespace

void CellMap::mark_changes(TileCells cells) {
  uint8x16_t before = vdupq_n_u8(std::to_integer<std::uint8_t>(cells[0]));
  for (std::size_t y = 0; y < kTileSide; ++y) {
    const Row row = row_of(cells, y);
    store_differences(row, {vextq_u8(before, row.left, 15), vextq_u8(row.left, row.right, 15)},
                      rows_[y]);
    before = row.right;
  }
  rows_[kTileSide] = 1;
}

void CellMap::mark_steps(TileCells cells) {
  Row below = row_of(cells, 0);
  for (std::size_t y = 0; y < kTileSide; ++y) {
    const Row row = row_of(cells, y);
    store_differences(row, below, rows_[y]);
    below = row;
  }
  rows_[kTileSide] = 1;
}

void CellMap::mark_differences(TileCells cells, TileCells others) {
  for (std::size_t y = 0; y < kTileSide; ++y) {
    store_differences(row_of(cells, y), row_of(others, y), rows_[y]);
  }
  rows_[kTileSide] = 1;
}

}  // namespace iog::tile_coding
