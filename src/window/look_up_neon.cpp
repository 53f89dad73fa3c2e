// What look_up.cpp says, for the target. One instruction multiplies the upper half of a coordinate
// and adds, one load takes the upper half of the other; with two steps and its place in a word a
// cell is five instructions. The compiler knows them all, but makes shifts and additions of a
// stride that it knows, and multiples of the step for which it has no registers.
#include <algorithm>
#include <arm_neon.h>

#include "window/look_up.hpp"

namespace iog::window {
namespace {

static_assert(kFineBits == 16, "half of a word");

constexpr std::int32_t kRow = geometry::kTileSide;
constexpr std::int32_t kHalf = kRow / 2;
static_assert(kBlockReach <= kHalf);

// Cells of the grid from an origin on, kRow from one row to the next.
struct Patch {
  const std::int8_t* cells;
  geometry::Cell origin;
};

// Where a block has cells in several tiles, those around it.
using PatchRows = std::array<std::int8_t, std::size_t{kBlockReach * kRow}>;

// Rows of half a tile's width side by side.
std::int8_t* put_rows(const std::int8_t* left, const std::int8_t* right, std::int32_t count,
                      std::int8_t* to) {
  for (; count > 0; --count, left += kRow, right += kRow, to += kRow) {
    const int8x16_t one = vld1q_s8(left);
    const int8x16_t other = vld1q_s8(right);
    vst1q_s8(to, one);
    vst1q_s8(to + kHalf, other);
  }
  return to;
}

// The cells from low to high: where they lie in one tile, or a copy in the memory.
Patch patch_of(const SliceCells& slice, geometry::Cell low, geometry::Cell high,
               PatchRows& memory) {
  const geometry::Cell tile{low.x >> geometry::kTileSideLog2, low.y >> geometry::kTileSideLog2};
  const geometry::Cell last{high.x >> geometry::kTileSideLog2, high.y >> geometry::kTileSideLog2};
  if (tile == last) {
    return {.cells = slice.cells(tile).data(), .origin = {tile.x * kRow, tile.y * kRow}};
  }
  // Of two tiles the halves that meet, of one both.
  const std::int32_t from = tile.x == last.x ? 0 : kHalf;
  const std::int32_t to = tile.x == last.x ? kHalf : 0;
  const std::int32_t end = std::min(high.y + 1, (tile.y + 1) * kRow);
  const std::int32_t first = (low.y - tile.y * kRow) * kRow;
  std::int8_t* const next =
      put_rows(slice.cells(tile).data() + first + from,
               slice.cells({last.x, tile.y}).data() + first + to, end - low.y, memory.data());
  if (tile.y != last.y) {
    put_rows(slice.cells({tile.x, last.y}).data() + from, slice.cells(last).data() + to,
             high.y + 1 - end, next);
  }
  return {.cells = memory.data(), .origin = {tile.x * kRow + from, low.y}};
}

// Four cells, the first in the lowest byte. The point takes four steps.
inline std::uint32_t look_up_four(const std::int8_t* cells, FinePoint& at, FinePoint step) {
  std::uint32_t word;
  std::uint32_t byte;
  const std::int8_t* row;
  asm("smlatb %[row], %[y], %[stride], %[cells]\n\t"
      "ldrb %[word], [%[row], %[x], asr #16]\n\t"
      "add %[y], %[y], %[step_y]\n\t"
      "add %[x], %[x], %[step_x]\n\t"
      "smlatb %[row], %[y], %[stride], %[cells]\n\t"
      "ldrb %[byte], [%[row], %[x], asr #16]\n\t"
      "add %[y], %[y], %[step_y]\n\t"
      "add %[x], %[x], %[step_x]\n\t"
      "orr %[word], %[word], %[byte], lsl #8\n\t"
      "smlatb %[row], %[y], %[stride], %[cells]\n\t"
      "ldrb %[byte], [%[row], %[x], asr #16]\n\t"
      "add %[y], %[y], %[step_y]\n\t"
      "add %[x], %[x], %[step_x]\n\t"
      "orr %[word], %[word], %[byte], lsl #16\n\t"
      "smlatb %[row], %[y], %[stride], %[cells]\n\t"
      "ldrb %[byte], [%[row], %[x], asr #16]\n\t"
      "add %[y], %[y], %[step_y]\n\t"
      "add %[x], %[x], %[step_x]\n\t"
      "orr %[word], %[word], %[byte], lsl #24"
      : [word] "=&r"(word), [byte] "=&r"(byte), [row] "=&r"(row), [x] "+&r"(at.x), [y] "+&r"(at.y)
      : [cells] "r"(cells), [stride] "r"(kRow), [step_x] "r"(step.x), [step_y] "r"(step.y)
      : "memory");
  return word;
}

// The eight cells of a row. The point goes to the row's end. By way of memory, as the compiler
// would have it, they would wait for their stores.
inline int8x8_t look_up_row(const std::int8_t* cells, FinePoint& at, FinePoint step) {
  const std::uint32_t left = look_up_four(cells, at, step);
  const std::uint32_t right = look_up_four(cells, at, step);
  int8x8_t row;
  asm("vmov %P[row], %[left], %[right]" : [row] "=w"(row) : [left] "r"(left), [right] "r"(right));
  return row;
}

inline int8x8_t load_row(const std::int8_t* from) {
  int8x8_t row;
  __builtin_memcpy(&row, __builtin_assume_aligned(from, sizeof row), sizeof row);
  return row;
}
inline void store_row(int8x8_t row, std::int8_t* to) {
  __builtin_memcpy(__builtin_assume_aligned(to, sizeof row), &row, sizeof row);
}

// joined_free() of sixteen cells. How free they are are six bits of a byte. Shifted by three, their
// five bits of an index saturate where a sum is above 31; shifted back, they are put behind the bit
// of either.
inline int8x16_t join_free(int8x16_t evidence, int8x16_t found) {
  static_assert(kMostIndex == 0x1F && kBeside == 0x20);
  const int8x16_t zero = vdupq_n_s8(0);
  const uint8x16_t before = vreinterpretq_u8_s8(vnegq_s8(evidence));
  const uint8x16_t next = vreinterpretq_u8_s8(vnegq_s8(vminq_s8(found, zero)));
  const uint8x16_t sums = vqaddq_u8(vshlq_n_u8(before, 3), vshlq_n_u8(next, 3));
  const int8x16_t joined = vreinterpretq_s8_u8(vsriq_n_u8(vorrq_u8(before, next), sums, 3));
  return vbslq_s8(vcgtq_s8(evidence, zero), evidence, vnegq_s8(joined));
}

}  // namespace

void pull_block(const SliceCells& slice, FinePoint first, FinePoint step, geometry::Cell low,
                geometry::Cell high, std::int8_t* evidence) {
  constexpr std::int32_t kSide = SliceCells::kBlockSide;
  static_assert(kSide == 8);
  alignas(16) PatchRows memory;
  const Patch patch = patch_of(slice, low, high, memory);
  first = {first.x - (patch.origin.x << kFineBits), first.y - (patch.origin.y << kFineBits)};
  // From behind the last cell of a row to the first of the next.
  const FinePoint to_next{-kSide * step.x - step.y, -kSide * step.y + step.x};
  std::int8_t* const end = evidence + kSide * kTileSide;
  for (; evidence != end; evidence += 2 * kTileSide) {
    const int8x8_t before = load_row(evidence);
    const int8x8_t above = load_row(evidence + kTileSide);
    const int8x8_t lower = look_up_row(patch.cells, first, step);
    first = {first.x + to_next.x, first.y + to_next.y};
    const int8x8_t upper = look_up_row(patch.cells, first, step);
    first = {first.x + to_next.x, first.y + to_next.y};
    const int8x16_t after = join_free(vcombine_s8(before, above), vcombine_s8(lower, upper));
    store_row(vget_low_s8(after), evidence);
    store_row(vget_high_s8(after), evidence + kTileSide);
  }
}

}  // namespace iog::window
