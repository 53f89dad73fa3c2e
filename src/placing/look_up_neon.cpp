// The NEON version of look_up.cpp. The eight cells of a run lie in a few rows and eight columns of
// the grid. These are loaded as they are stored, and looked up in registers. On the Cortex-A9 a
// byte load takes two cycles, and computing its address three more instructions.
#include <algorithm>
#include <arm_neon.h>

#include "lanes/moves_neon.hpp"
#include "placing/known_blocks.hpp"
#include "placing/look_up.hpp"

namespace iog::placing {
namespace {

static_assert(kFineBits == 16, "half of a word");

constexpr std::int32_t kRow = geometry::kTileSide;
constexpr std::int32_t kHalf = kRow / 2;
static_assert(kBlockReach <= kHalf);

// Cells of the grid from an origin on, with a row stride of kRow.
struct Patch {
  const std::int8_t* cells;
  geometry::Cell origin;
};

// A copy of the cells around a block that lies in several tiles. A run reads all rows and columns
// that it may cover, even beyond the end of the patch.
constexpr std::int32_t kReadRows = kBlockReach + EightSteps::kMostRows;
using PatchRows = std::array<std::int8_t, std::size_t{kReadRows * kRow}>;
static_assert(EightSteps::kMostRows < kRow);

using Block = std::array<int8x8_t, EightSteps::kCount>;

// Copies rows that consist of two half rows.
std::int8_t* put_rows(const std::int8_t* left, const std::int8_t* right, std::int32_t count,
                      std::int8_t* to) {
  for (; count > 0; --count) {
    lanes::copy_next_halves(left, right, to);
  }
  return to;
}

// The cells low ... high: in place if they lie in one tile, otherwise copied to `memory`.
template <typename Shape>
Patch patch_of(const SliceCells& slice, const Shape& shape, geometry::Cell low, geometry::Cell high,
               PatchRows& memory) {
  const auto cells = [&](geometry::Cell its) { return slice.cells(its, shape).data(); };
  const geometry::Cell tile{low.x >> geometry::kTileSideLog2, low.y >> geometry::kTileSideLog2};
  const geometry::Cell last{high.x >> geometry::kTileSideLog2, high.y >> geometry::kTileSideLog2};
  if (tile == last) {
    return {.cells = cells(tile), .origin = {tile.x * kRow, tile.y * kRow}};
  }
  // From two tiles the halves that meet; from one tile both halves.
  const std::int32_t from = tile.x == last.x ? 0 : kHalf;
  const std::int32_t to = tile.x == last.x ? kHalf : 0;
  const std::int32_t end = std::min(high.y + 1, (tile.y + 1) * kRow);
  const std::int32_t first = (low.y - tile.y * kRow) * kRow;
  std::int8_t* const next = put_rows(
      cells(tile) + first + from, cells({last.x, tile.y}) + first + to, end - low.y, memory.data());
  if (tile.y != last.y) {
    put_rows(cells({tile.x, last.y}) + from, cells(last) + to, high.y + 1 - end, next);
  }
  return {.cells = memory.data(), .origin = {tile.x * kRow + from, low.y}};
}

// EightSteps in registers.
struct Steps {
  explicit Steps(const EightSteps& steps)
      : wholes(vld1q_u16(steps.wholes.data())),
        most_x(vld1q_u16(steps.most_x.data())),
        most_y(vld1q_u16(steps.most_y.data())) {}

  // low: the lowest point of a run. Returns the positions of its cells in kMostRows rows of
  // kColumns.
  [[nodiscard]] uint8x8_t places(FinePoint low) const {
    const auto x = vdupq_n_u16(static_cast<std::uint16_t>(low.x));
    const auto y = vdupq_n_u16(static_cast<std::uint16_t>(low.y));
    // All ones, which is -1, where the cell is one further.
    const uint16x8_t more_columns = vcgtq_u16(x, most_x);
    const uint16x8_t more_rows = vcgtq_u16(y, most_y);
    static_assert(EightSteps::kColumns == 1 << 3);
    return vmovn_u16(vsubq_u16(vsubq_u16(wholes, more_columns), vshlq_n_u16(more_rows, 3)));
  }

  uint16x8_t wholes;
  uint16x8_t most_x;
  uint16x8_t most_y;
};

// The cell of a patch at a point. The upper half of a coordinate is the cell number.
inline const std::int8_t* cell_at(const std::int8_t* cells, FinePoint point) {
  return lanes::row_at(cells, point.y, kRow) + (point.x >> kFineBits);
}

// Looks up the cells of a run. `low`: its lowest row and column.
template <int kRows>
inline int8x8_t look_up_run(const std::int8_t* cells, FinePoint low, const Steps& steps) {
  const uint8x8_t places = steps.places(low);
  const auto* const from = reinterpret_cast<const std::uint8_t*>(cell_at(cells, low));
  const auto row = [from](int y) { return vld1_u8(from + y * kRow); };
  if constexpr (kRows == 2) {
    return vreinterpret_s8_u8(vtbl2_u8({{row(0), row(1)}}, places));
  } else {
    const uint8x8_t of_four = vtbl4_u8({{row(0), row(1), row(2), row(3)}}, places);
    if constexpr (kRows == 4) {
      return vreinterpret_s8_u8(of_four);
    } else {
      constexpr std::uint8_t kOfFour = 4 * EightSteps::kColumns;
      return vreinterpret_s8_u8(
          vtbx2_u8(of_four, {{row(4), row(5)}}, vsub_u8(places, vdup_n_u8(kOfFour))));
    }
  }
}

inline int8x8_t load_row(const std::int8_t* from) {
  int8x8_t row;
  __builtin_memcpy(&row, __builtin_assume_aligned(from, sizeof row), sizeof row);
  return row;
}
inline void store_row(int8x8_t row, std::int8_t* to) {
  __builtin_memcpy(__builtin_assume_aligned(to, sizeof row), &row, sizeof row);
}

// joined_free() for sixteen cells. A negated free byte has six bits: five of the index and the
// extra bit. Shifted left by three, the sums of the indexes saturate above 31. Shifted back, they
// are inserted below the union of the extra bits.
inline int8x16_t join_free(int8x16_t evidence, int8x16_t found) {
  static_assert(kMostIndex == 0x1F && kBeside == 0x20);
  const int8x16_t zero = vdupq_n_s8(0);
  const uint8x16_t before = vreinterpretq_u8_s8(vnegq_s8(evidence));
  const uint8x16_t next = vreinterpretq_u8_s8(vnegq_s8(vminq_s8(found, zero)));
  const uint8x16_t sums = vqaddq_u8(vshlq_n_u8(before, 3), vshlq_n_u8(next, 3));
  const int8x16_t joined = vreinterpretq_s8_u8(vsriq_n_u8(vorrq_u8(before, next), sums, 3));
  return vbslq_s8(vcgtq_s8(evidence, zero), evidence, vnegq_s8(joined));
}

// Transposes eight by eight cells.
inline void turn(Block& cells) {
  const int8x8x2_t a = vtrn_s8(cells[0], cells[1]);
  const int8x8x2_t b = vtrn_s8(cells[2], cells[3]);
  const int8x8x2_t c = vtrn_s8(cells[4], cells[5]);
  const int8x8x2_t d = vtrn_s8(cells[6], cells[7]);
  const auto fours = [](int8x8_t low, int8x8_t high) {
    return vtrn_s16(vreinterpret_s16_s8(low), vreinterpret_s16_s8(high));
  };
  const int16x4x2_t even_low = fours(a.val[0], b.val[0]);
  const int16x4x2_t odd_low = fours(a.val[1], b.val[1]);
  const int16x4x2_t even_high = fours(c.val[0], d.val[0]);
  const int16x4x2_t odd_high = fours(c.val[1], d.val[1]);
  const auto put = [&cells](std::size_t at, int16x4_t low, int16x4_t high) {
    const int32x2x2_t both = vtrn_s32(vreinterpret_s32_s16(low), vreinterpret_s32_s16(high));
    cells[at] = vreinterpret_s8_s32(both.val[0]);
    cells[at + 4] = vreinterpret_s8_s32(both.val[1]);
  };
  put(0, even_low.val[0], even_high.val[0]);
  put(1, odd_low.val[0], odd_high.val[0]);
  put(2, even_low.val[1], even_high.val[1]);
  put(3, odd_low.val[1], odd_high.val[1]);
}

inline void join_rows(int8x8_t lower, int8x8_t upper, std::int8_t* evidence) {
  const int8x8_t before = load_row(evidence);
  const int8x8_t above = load_row(evidence + window::kTileSide);
  const int8x16_t after = join_free(vcombine_s8(before, above), vcombine_s8(lower, upper));
  store_row(vget_low_s8(after), evidence);
  store_row(vget_high_s8(after), evidence + window::kTileSide);
}

// Gathers a block of eight by eight cells. `low`: the lowest point of its first run in the patch.
template <int kRows>
inline void pull_along_x(const std::int8_t* cells, FinePoint low, FinePoint to_next,
                         const Steps& steps, std::int8_t* evidence) {
  std::int8_t* const end = evidence + SliceCells::kBlockSide * window::kTileSide;
  // Without this, all addresses are computed before the first is used, and exceed the registers.
#pragma GCC unroll 1
  for (; evidence != end; evidence += 2 * window::kTileSide) {
    const int8x8_t lower = look_up_run<kRows>(cells, low, steps);
    low = {low.x + to_next.x, low.y + to_next.y};
    const int8x8_t upper = look_up_run<kRows>(cells, low, steps);
    low = {low.x + to_next.x, low.y + to_next.y};
    join_rows(lower, upper, evidence);
  }
}
template <int kRows>
inline void pull_along_y(const std::int8_t* cells, FinePoint low, FinePoint to_next,
                         const Steps& steps, std::int8_t* evidence) {
  Block found;
#pragma GCC unroll 8
  for (int8x8_t& run : found) {
    run = look_up_run<kRows>(cells, low, steps);
    low = {low.x + to_next.x, low.y + to_next.y};
  }
  turn(found);
#pragma GCC unroll 4
  for (std::size_t y = 0; y < found.size(); y += 2) {
    join_rows(found[y], found[y + 1], evidence + y * window::kTileSide);
  }
}

// One instance for each case, so blocks need no branches and the steps stay in registers.
template <int kRows, bool kIsAlongY, typename Shape>
bool pull_blocks(const SliceCells& slice, const Shape& shape, FinePoint first,
                 const EightSteps& steps, std::span<std::int8_t, geometry::kTileCells> evidence) {
  static_assert(SliceCells::kBlockSide == EightSteps::kCount);
  alignas(16) PatchRows memory;
  const Steps lanes(steps);
  const FinePoint to_low = steps.to_low;
  const FinePoint to_next = steps.to_next;
  return for_each_known_block(
      slice, shape, first, steps.step, evidence,
      [&](FinePoint at, geometry::Cell low, geometry::Cell high, std::int8_t* cells) {
        const Patch patch = patch_of(slice, shape, low, high, memory);
        const FinePoint lowest{at.x + to_low.x - (patch.origin.x << kFineBits),
                               at.y + to_low.y - (patch.origin.y << kFineBits)};
        if constexpr (kIsAlongY) {
          pull_along_y<kRows>(patch.cells, lowest, to_next, lanes, cells);
        } else {
          pull_along_x<kRows>(patch.cells, lowest, to_next, lanes, cells);
        }
      });
}

template <bool kIsAlongY, typename Shape>
bool pull_along(const SliceCells& slice, const Shape& shape, FinePoint first,
                const EightSteps& steps, std::span<std::int8_t, geometry::kTileCells> evidence) {
  if (steps.rows <= 2) {
    return pull_blocks<2, kIsAlongY>(slice, shape, first, steps, evidence);
  }
  if (steps.rows <= 4) {
    return pull_blocks<4, kIsAlongY>(slice, shape, first, steps, evidence);
  }
  return pull_blocks<EightSteps::kMostRows, kIsAlongY>(slice, shape, first, steps, evidence);
}

}  // namespace

bool pull_tile(const SliceCells& slice, FinePoint first, const EightSteps& steps,
               std::span<std::int8_t, geometry::kTileCells> evidence) {
  return slice.with_shape([&](const auto& shape) {
    return steps.is_along_y ? pull_along<true>(slice, shape, first, steps, evidence)
                            : pull_along<false>(slice, shape, first, steps, evidence);
  });
}

}  // namespace iog::placing
