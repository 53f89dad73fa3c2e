// The NEON version of slice_bytes.cpp. It handles a row of squares at a time and collects the notes
// in parallel. Transfers to core registers are slow, so they happen only at the end.
#include <arm_neon.h>

#include "placing/slice_bytes.hpp"

namespace iog::placing {
namespace {

constexpr std::size_t kRowBytes = geometry::kTileSide;
constexpr std::size_t kHalfRow = kRowBytes / 2;

// Four rows of sixteen cells: the union of the bits, and the maximum, of each column.
struct Columns {
  int8x16_t bits;
  int8x16_t greatest;
};

Columns write_half(const std::int8_t* indexes, std::int8_t* bytes) {
  const int8x16_t most = vdupq_n_s8(kMostIndex);
  const int8x16_t least = vdupq_n_s8(-kMostIndex);
  const auto write = [&](std::size_t row) {
    const int8x16_t cells = vld1q_s8(indexes + row * kRowBytes);
    vst1q_s8(bytes + row * kRowBytes, vmaxq_s8(vminq_s8(cells, most), least));
    return cells;
  };
  const int8x16_t a = write(0);
  const int8x16_t b = write(1);
  const int8x16_t c = write(2);
  const int8x16_t d = write(3);
  return {.bits = vorrq_s8(vorrq_s8(a, b), vorrq_s8(c, d)),
          .greatest = vmaxq_s8(vmaxq_s8(a, b), vmaxq_s8(c, d))};
}

// All ones for each square of four columns with a known cell.
uint16x4_t known_squares(int8x16_t bits) {
  const uint32x4_t squares = vreinterpretq_u32_s8(bits);
  return vmovn_u32(vtstq_u32(squares, squares));
}

// The sums of the lanes of each of eight rows.
uint8x8_t sums_of(const std::array<uint8x8_t, kSquaresOfTile>& rows) {
  return vpadd_u8(vpadd_u8(vpadd_u8(rows[0], rows[1]), vpadd_u8(rows[2], rows[3])),
                  vpadd_u8(vpadd_u8(rows[4], rows[5]), vpadd_u8(rows[6], rows[7])));
}

int8x8_t greatest_of(const std::array<int8x8_t, kSquaresOfTile>& rows) {
  return vpmax_s8(vpmax_s8(vpmax_s8(rows[0], rows[1]), vpmax_s8(rows[2], rows[3])),
                  vpmax_s8(vpmax_s8(rows[4], rows[5]), vpmax_s8(rows[6], rows[7])));
}

}  // namespace

TileNotes write_bytes(const std::int8_t* indexes, std::int8_t* bytes) {
  const uint8x8_t bit_of_square = vcreate_u8(0x8040'2010'0804'0201);
  std::array<uint8x8_t, kSquaresOfTile> known;
  std::array<int8x8_t, kSquaresOfTile> greatest;
  for (std::size_t y = 0; y < kSquaresOfTile; ++y) {
    const Columns left = write_half(indexes, bytes);
    const Columns right = write_half(indexes + kHalfRow, bytes + kHalfRow);
    const uint16x8_t squares = vcombine_u16(known_squares(left.bits), known_squares(right.bits));
    known[y] = vand_u8(vmovn_u16(squares), bit_of_square);
    const int8x16_t both = vmaxq_s8(left.greatest, right.greatest);
    greatest[y] = vpmax_s8(vget_low_s8(both), vget_high_s8(both));
    indexes += kSquareSide * kRowBytes;
    bytes += kSquareSide * kRowBytes;
  }
  TileNotes notes;
  vst1_u8(notes.known.data(), sums_of(known));
  // A band is two rows of squares.
  const uint8x8_t is_hit = vcgt_s8(greatest_of(greatest), vdup_n_s8(0));
  const uint8x8_t bit_of_band = vcreate_u8(0x0808'0404'0202'0101);
  uint8x8_t bands = vand_u8(is_hit, bit_of_band);
  bands = vpmax_u8(bands, bands);
  bands = vpadd_u8(bands, bands);
  bands = vpadd_u8(bands, bands);
  notes.hit_bands = vget_lane_u8(bands, 0);
  return notes;
}

void set_beside(const window::Plane& cells, std::int8_t* bytes) {
  const uint8x8_t own = vcreate_u8(0x8040'2010'0804'0201U);
  const int8x16_t beside = vdupq_n_s8(kBeside);
  const auto turn_round = [&](uint8x8_t left, uint8x8_t right, std::int8_t* half) {
    const uint8x16_t is_set = vtstq_u8(vcombine_u8(left, right), vcombine_u8(own, own));
    vst1q_s8(half, veorq_s8(vld1q_s8(half), vandq_s8(vreinterpretq_s8_u8(is_set), beside)));
  };
  for (const std::uint32_t row : cells) {
    if (row != 0) {
      const uint8x8_t eights = vreinterpret_u8_u32(vdup_n_u32(row));
      turn_round(vdup_lane_u8(eights, 0), vdup_lane_u8(eights, 1), bytes);
      turn_round(vdup_lane_u8(eights, 2), vdup_lane_u8(eights, 3), bytes + kHalfRow);
    }
    bytes += kRowBytes;
  }
}

}  // namespace iog::placing
