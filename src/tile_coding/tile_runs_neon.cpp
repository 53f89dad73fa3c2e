// The NEON twin of tile_runs.cpp. No loop iterates over runs.
//
// 1. Two rows at a time, every cell is compared with the previous cell and with the reference. The
// loads distribute cells over four registers, so the previous cell is mostly in the same lane of
// another register. Shifts gather one bit of each.
//
// 2. A run continues through unchanged cells as a carry ripples through ones. The tile is one
// number of 1024 bits with cell 0 lowest, and one addition finds every cell that continues a run
// with a value.
//
// 3. The cells at which runs start are compacted, eight at a time, by a byte table.
#include <arm_neon.h>

#include "lanes/moves_neon.hpp"
#include "tile_coding/tile_runs.hpp"

namespace iog::tile_coding {
namespace {

using Word = std::uint32_t;
using Bits = std::array<Word, kTileSide>;

constexpr auto kNone = std::to_integer<std::uint8_t>(kNoIndex);

constexpr std::size_t kTwoRows = 2 * kTileSide;

// Cells 0, 4, 8 ... of two rows, then cells 1, 5, 9 ..., and so on.
using Dealt = uint8x16x4_t;

const std::uint8_t* bytes_of(TileCells cells) {
  return reinterpret_cast<const std::uint8_t*>(cells.data());
}

// One bit per cell in row order. Each input byte is all ones or all zeros.
uint8x8_t bits_of(const Dealt& set) {
  const uint8x16_t high = vsriq_n_u8(set.val[3], set.val[2], 1);
  const uint8x16_t low = vsriq_n_u8(set.val[1], set.val[0], 1);
  const uint16x8_t fours = vreinterpretq_u16_u8(vsriq_n_u8(high, low, 2));  // in the upper halves
  return vsri_n_u8(vshrn_n_u16(fours, 8), vmovn_u16(fours), 4);
}

void store(uint8x8_t bits, Word* words) { vst1_u8(reinterpret_cast<std::uint8_t*>(words), bits); }

// Bits of a tile's cells: differs from the reference; same as the previous cell; either of these.
struct Marks {
  alignas(16) Bits differ;
  alignas(16) Bits same;
  alignas(16) Bits open;
};

// last: the last register of the previous two rows. The tile's first cell counts as unchanged.
Dealt same_as_before(const Dealt& cells, uint8x16_t last) {
  const uint8x16_t before = vextq_u8(last, cells.val[3], 15);
  return {{vceqq_u8(cells.val[0], before), vceqq_u8(cells.val[1], cells.val[0]),
           vceqq_u8(cells.val[2], cells.val[1]), vceqq_u8(cells.val[3], cells.val[2])}};
}

void mark(const Dealt& as_reference, const Dealt& as_before, Marks& marks, std::size_t y) {
  const uint8x8_t differ = vmvn_u8(bits_of(as_reference));
  const uint8x8_t same = bits_of(as_before);
  store(differ, &marks.differ[y]);
  store(same, &marks.same[y]);
  store(vorr_u8(differ, same), &marks.open[y]);
}

void mark(const std::uint8_t* cells, Marks& marks) {
  uint8x16_t last = vdupq_n_u8(*cells);
  for (std::size_t y = 0; y < kTileSide; y += 2, cells += kTwoRows) {
    const Dealt rows = vld4q_u8(cells);
    const Dealt unknown{{vceqq_u8(rows.val[0], vdupq_n_u8(0)), vceqq_u8(rows.val[1], vdupq_n_u8(0)),
                         vceqq_u8(rows.val[2], vdupq_n_u8(0)),
                         vceqq_u8(rows.val[3], vdupq_n_u8(0))}};
    mark(unknown, same_as_before(rows, last), marks, y);
    last = rows.val[3];
  }
}

// Replaces equal cells by kNoIndex.
uint8x16_t none_where(uint8x16_t equal, uint8x16_t cells) {
  return lanes::replaced(cells, vdupq_n_u8(kNone), equal);
}

// `values`: the cells, with kNoIndex for those equal to the reference.
void mark(const std::uint8_t* cells, const std::uint8_t* reference, Marks& marks,
          std::uint8_t* values) {
  uint8x16_t last = vdupq_n_u8(*cells);
  for (std::size_t y = 0; y < kTileSide; y += 2) {
    const Dealt rows = vld4q_u8(cells);
    const Dealt others = vld4q_u8(reference);
    const Dealt equal{{vceqq_u8(rows.val[0], others.val[0]), vceqq_u8(rows.val[1], others.val[1]),
                       vceqq_u8(rows.val[2], others.val[2]), vceqq_u8(rows.val[3], others.val[3])}};
    mark(equal, same_as_before(rows, last), marks, y);
    last = rows.val[3];
    vst4q_u8(values,
             {{none_where(equal.val[0], rows.val[0]), none_where(equal.val[1], rows.val[1]),
               none_where(equal.val[2], rows.val[2]), none_where(equal.val[3], rows.val[3])}});
    cells += kTwoRows;
    reference += kTwoRows;
    values += kTwoRows;
  }
}

// A cell belongs to a run with a value if it differs from the reference, or if it is unchanged and
// the previous cell belongs to one. Adding `differ` to `open` carries into each cell after such a
// cell. In these cells a run starts at a change of value, in all others where the cell differs.
void find_starts(const Marks& marks, Bits& starts) {
  alignas(16) Bits sum;
  lanes::add(marks.open, marks.differ, sum);
  for (std::size_t y = 0; y < kTileSide; y += 4) {
    const uint32x4_t differ = vld1q_u32(&marks.differ[y]);
    const uint32x4_t carried = veorq_u32(vld1q_u32(&sum[y]), vld1q_u32(&marks.open[y]));
    const uint32x4_t behind = veorq_u32(carried, differ);
    vst1q_u32(&starts[y], vbslq_u32(behind, vmvnq_u32(vld1q_u32(&marks.same[y])), differ));
  }
}

// For each byte: the positions of its set bits, in ascending order.
using Places = std::array<std::array<std::uint8_t, 8>, 256>;

consteval Places make_places() {
  Places places{};
  for (unsigned bits = 0; bits < places.size(); ++bits) {
    std::size_t count = 0;
    for (std::uint8_t place = 0; place < 8; ++place) {
      if ((bits >> place & 1U) != 0) {
        places[bits][count++] = place;
      }
    }
  }
  return places;
}
alignas(32) constexpr Places kPlaces = make_places();

// Moves the bytes whose bit is set to the front. Writes eight bytes, `count` of them valid.
void gather(uint8x8_t bytes, Word bits, Word count, std::uint8_t*& out) {
  const uint8x8_t together = vtbl1_u8(bytes, vld1_u8(kPlaces[bits & 0xFFU].data()));
  lanes::store_some(together, count & 0xFFU, out);
}

// The number of set bits of each byte.
void count(const Bits& bits, Bits& counts) {
  for (std::size_t y = 0; y < kTileSide; y += 4) {
    const uint8x16_t four_rows = vreinterpretq_u8_u32(vld1q_u32(&bits[y]));
    vst1q_u32(&counts[y], vreinterpretq_u32_u8(vcntq_u8(four_rows)));
  }
}

void gather_row(uint8x16_t left, uint8x16_t right, Word bits, Word counts, std::uint8_t*& out) {
  gather(vget_low_u8(left), bits, counts, out);
  gather(vget_high_u8(left), bits >> 8, counts >> 8, out);
  gather(vget_low_u8(right), bits >> 16, counts >> 16, out);
  gather(vget_high_u8(right), bits >> 24, counts >> 24, out);
}

// Compacts the bytes of a tile whose bit is set, and returns the end of the result.
std::uint8_t* gather(const std::uint8_t* bytes, const Bits& bits, std::uint8_t* out) {
  alignas(16) Bits counts;
  count(bits, counts);
  for (std::size_t y = 0; y < kTileSide; ++y, bytes += kTileSide) {
    if (bits[y] != 0) {
      gather_row(vld1q_u8(bytes), vld1q_u8(bytes + 16), bits[y], counts[y], out);
    }
  }
  return out;
}

constexpr std::size_t kSets = TileRuns::kSets;
using Blocks = std::array<std::uint8_t, TileRuns::kBlocks>;

// Joins four bits of a row with the four bits above them in the next row.
void join_rows(const Bits& rows, Blocks& blocks) {
  std::uint8_t* out = blocks.data();
  for (std::size_t y = 0; y < kTileSide; y += 8, out += 32) {
    const uint32x4x2_t eight_rows = vld2q_u32(&rows[y]);
    const uint8x16_t even = vreinterpretq_u8_u32(eight_rows.val[0]);
    const uint8x16_t odd = vreinterpretq_u8_u32(eight_rows.val[1]);
    const uint8x16x2_t joined = vzipq_u8(vsliq_n_u8(even, odd, 4), vsriq_n_u8(odd, even, 4));
    vst1q_u8(out, joined.val[0]);
    vst1q_u8(out + 16, joined.val[1]);
  }
}

// One bit per byte, set if the byte is not zero.
uint8x16_t nonzero_bytes(const Blocks& blocks) {
  constexpr std::uint64_t kOneOfEach = 0x8040201008040201;
  const uint8x16_t one_of_each = vreinterpretq_u8_u64(vdupq_n_u64(kOneOfEach));
  const auto twos_of = [&](std::size_t at) {
    const uint8x16_t bytes = vld1q_u8(&blocks[at]);
    const uint8x16_t kept = vandq_u8(vtstq_u8(bytes, bytes), one_of_each);
    return vpadd_u8(vget_low_u8(kept), vget_high_u8(kept));
  };
  const auto fours_of = [&](std::size_t at) { return vpadd_u8(twos_of(at), twos_of(at + 16)); };
  return vcombine_u8(vpadd_u8(fours_of(0), fours_of(32)), vpadd_u8(fours_of(64), fours_of(96)));
}

}  // namespace

void TileRuns::find(TileCells cells, const std::optional<TileCells>& reference) {
  Marks marks;
  alignas(16) std::array<std::uint8_t, kTileBytes> values;
  const std::uint8_t* from = bytes_of(cells);
  if (reference) {
    mark(from, bytes_of(*reference), marks, values.data());
    from = values.data();
  } else {
    mark(from, marks);
  }
  as_reference_ = reference ? kNone : 0;
  find_starts(marks, starts_);
  auto* const begin = reinterpret_cast<std::uint8_t*>(values_.data());
  std::uint8_t* const out = gather(from, starts_, begin);
  vst1_u8(out, vdup_n_u8(as_reference_));
  count_ = static_cast<std::size_t>(out - begin);
}

std::size_t TileRuns::write_starts(std::span<std::byte, kMostStartBytes> out) const {
  auto* const sets = reinterpret_cast<std::uint8_t*>(out.data());
  alignas(16) Blocks blocks;
  join_rows(starts_, blocks);
  alignas(16) std::array<std::uint8_t, kSets> is_set;
  alignas(16) std::array<std::uint8_t, kSets> counts;
  const uint8x16_t nonzero = nonzero_bytes(blocks);
  vst1q_u8(sets, nonzero);
  vst1q_u8(is_set.data(), nonzero);
  vst1q_u8(counts.data(), vcntq_u8(nonzero));
  std::uint8_t* next = sets + kSets;
  for (std::size_t set = 0; set < kSets; ++set) {
    gather(vld1_u8(&blocks[8 * set]), is_set[set], counts[set], next);
  }
  return static_cast<std::size_t>(next - sets);
}

}  // namespace iog::tile_coding
