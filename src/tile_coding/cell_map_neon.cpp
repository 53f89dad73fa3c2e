// A row of cells is two registers. A comparison turns each byte into all ones or all zeros. Of each
// byte one bit is kept, a different one in each of eight neighbours. Three pairwise additions then
// gather the 32 bits of a row; the last addition does so for two rows at once.
#include <arm_neon.h>
#include <array>
#include <bit>

#include "tile_coding/cell_map.hpp"
#include "tile_coding/palette.hpp"

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

// A tile's marks are eight registers. A part is found by where it begins.
//
// With a window of 2^k cells, bit x of `near` says that a mark is in the window from cell x on. The
// window twice as long is this one and the one 2^k further. A part that begins at cell x has 2^k
// cells or more if no mark is in the window of 2^k - 1 from x + 1 on; of the parts that are left,
// each window further takes those that end in it. Behind the tile everything is marked.
class PartSizes {
 public:
  explicit PartSizes(const std::uint32_t* rows) {
    for (std::size_t i = 0; i < kRegisters; ++i) {
      near_[i] = vreinterpretq_u64_u32(vld1q_u32(rows + 4 * i));
    }
    near_[0] = vorrq_u64(near_[0], vcombine_u64(vcreate_u64(1), vcreate_u64(0)));
    left_ = near_;
  }

  // The parts that are left.
  [[nodiscard]] std::uint32_t count() const {
    uint16x8_t sums = vdupq_n_u16(0);
    for (const uint64x2_t& parts : left_) {
      sums = vpadalq_u8(sums, vcntq_u8(vreinterpretq_u8_u64(parts)));
    }
    return total(sums);
  }

  // Keeps the parts of twice as many cells, and adds their number.
  template <int kCells>
  void double_length(uint16x8_t& sums) {
    for (std::size_t i = 0; i < kRegisters; ++i) {
      const uint64x2_t behind = i + 1 < kRegisters ? near_[i + 1] : vdupq_n_u64(~0ULL);
      const uint64x2_t next = vextq_u64(near_[i], behind, 1);
      const uint64x2_t further = vsliq_n_u64(vshrq_n_u64(near_[i], kCells), next, 64 - kCells);
      near_[i] = vorrq_u64(near_[i], further);
      left_[i] = vbicq_u64(left_[i], further);
      sums = vpadalq_u8(sums, vcntq_u8(vreinterpretq_u8_u64(left_[i])));
    }
  }

  // At most 5 * 1024.
  static std::uint32_t total(uint16x8_t sums) {
    const uint64x2_t two = vpaddlq_u32(vpaddlq_u16(sums));
    return static_cast<std::uint32_t>(vgetq_lane_u64(two, 0) + vgetq_lane_u64(two, 1));
  }

 private:
  static constexpr std::size_t kRegisters = kTileBytes / 128;

  std::array<uint64x2_t, kRegisters> near_{};
  std::array<uint64x2_t, kRegisters> left_{};
};

// What log2 has above 5, of parts of 64 cells or more: each holds a row without a mark.
template <typename Rows>
std::size_t log2_above_5(const Rows& rows) {
  std::size_t sum = 0;
  const auto add = [&sum](std::size_t cells) { sum += cells < 64 ? 0 : 26 - leading_zeros(cells); };
  std::size_t begin = 0;
  bool is_open = false;  // the row before has no mark
  for (std::size_t y = 0; y < rows.size(); ++y) {
    const std::uint32_t row = rows[y];
    if (row == 0) {
      is_open = true;
      continue;
    }
    if (is_open) {
      add(y * kTileSide + static_cast<std::size_t>(std::countr_zero(row)) - begin);
      is_open = false;
    }
    begin = y * kTileSide + 31 - leading_zeros(row);
  }
  if (is_open) {
    add(kTileBytes - begin);
  }
  return sum;
}

}  // namespace

Parts CellMap::parts() const {
  PartSizes sizes(rows_.data());
  const std::size_t count = sizes.count();
  uint16x8_t sums = vdupq_n_u16(0);
  sizes.double_length<1>(sums);
  sizes.double_length<2>(sums);
  sizes.double_length<4>(sums);
  sizes.double_length<8>(sums);
  sizes.double_length<16>(sums);
  return {.count = count, .log2_sum = PartSizes::total(sums) + log2_above_5(rows_)};
}

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
