#include "grid/block_path.hpp"

#include <algorithm>

#include "require/require.hpp"
#include "traversal/corner.hpp"

namespace iog::grid {
namespace {

// Length of the longest line in subcells, and the largest number of columns in which its height is
// evaluated. car_block/limits.cpp ensures that the error term fits, sqrt(2) L r < 2^31, and that a
// range is at most 130 m in cells of at least 50 mm. A path stays on its line, except for one
// column of blocks before its start and one behind its end.
constexpr std::uint32_t kLongest = std::min((std::int64_t{1} << 31) / geometry::kResolution * 5 / 7,
                                            std::int64_t{130'000} / 50 * geometry::kResolution + 1);
constexpr std::int32_t kMostColumns = kLongest / geometry::kResolution + 1;
static_assert(kMostColumns + 2 * kBlockSide <= std::int64_t{traversal::most_columns(kLongest)});
}  // namespace

void BlockPath::begin(const vehicle::BeamLine& line, const BlockGrid& grid) {
  const geometry::Cell start = line.cell({});
  require(grid.area().contains(start));
  start_offset_ = offset_of(start, grid.stride());
  start_tile_ = static_cast<std::uint16_t>(geometry::tile_of(start, grid.tiles_across()));
  require(std::max(line.x().length(), line.y().length()) <= kLongest);
  orientation_ = {.is_steep = line.y().length() > line.x().length(),
                  .x_is_negative = line.x().step() < 0,
                  .y_is_negative = line.y().step() < 0};
  const auto into_tile = [](std::int32_t coordinate, bool is_negative) {
    const auto ahead = static_cast<std::uint32_t>(is_negative ? ~coordinate : coordinate);
    return static_cast<std::uint8_t>(ahead % geometry::kTileSide);
  };
  x_in_tile_ = into_tile(start.x, orientation_.x_is_negative);
  y_in_tile_ = into_tile(start.y, orientation_.y_is_negative);
  find_first_column(line);
}

// Follows the line from the left border of the column of blocks that contains its start, as if the
// line came from further back. Only cells from the start on count. The extended line may have
// passed through the block below, which is not on the path.
void BlockPath::find_first_column(const vehicle::BeamLine& line) {
  constexpr std::uint32_t kSide = kBlockSide;
  const std::uint32_t u_in_tile = orientation_.is_steep ? y_in_tile_ : x_in_tile_;
  const std::uint32_t v_in_tile = orientation_.is_steep ? x_in_tile_ : y_in_tile_;
  const std::uint32_t before = u_in_tile % kSide;
  const traversal::Dda dda = traversal::dda_of(line, orientation_.is_steep, before);
  phase_ = dda.phase;
  step_ = dda.step;
  const std::uint64_t columns_of_first_tile = geometry::kTileSide - u_in_tile + before;
  const auto row = static_cast<std::uint64_t>(std::int64_t{v_in_tile} + dda.row);
  // In 2^-32 rows. More columns do not change the lower bits that a tile has more than a row.
  const std::uint64_t height = ((row << 32) | dda.phase) + columns_of_first_tile * dda.step;
  tile_height_ = static_cast<std::uint32_t>(height >> geometry::kTileSideLog2);
  leaves_first_above_ = height >> (32 + geometry::kTileSideLog2) != 0;
  const std::int32_t v = static_cast<std::int32_t>(v_in_tile % kSide) + dda.row;
  v_ = static_cast<std::uint8_t>(static_cast<std::uint32_t>(v) % kSide);
  count_ = 0;
  find_up_to(v < 0 ? 1U : 0U);
  if (v < 0) {
    codes_[0] = codes_[1];
    --count_;
  }
  start_mask_ = masks().from[orientation_.inner(before, v_in_tile % kSide)].bytes;
  if (traversal::starts_on_corner(line)) {
    skip_cell_above(before, v_in_tile % kSide);
  }
}

// A line that starts on the corner through which it leaves its first cell was followed as if it
// rose first and then went on. It does not cross the cell above the first one. If that cell is the
// first of another block, the line enters that block in the next column, if at all.
void BlockPath::skip_cell_above(std::uint32_t u, std::uint32_t v) {
  if (v + 1 < kBlockSide) {
    start_mask_[orientation_.inner(u, v + 1)] = 0;
    return;
  }
  find_up_to(1);
  const BlockCode code = codes_[1];
  const std::uint32_t shape = shape_of(entered_from_below(u + 1), code >> 2U & 7U);
  codes_[1] = static_cast<BlockCode>(2 * shape + code % 2U);
}

void BlockPath::find_up_to(std::uint32_t block) {
  if (block < count_) {
    return;
  }
  require(block < kMaxBlocks);
  traversal::Dda dda{.phase = phase_, .step = step_};
  std::uint32_t v = v_;
  BlockCode* next = &codes_[count_];
  const BlockCode* const end = &codes_[block];
  do {
    for (std::int32_t u = 0; u < kBlockSide; ++u) {
      v = dda.advance(v);
    }
    const BlockColumn column = kBlockColumns[v];
    __builtin_memcpy(next, column.codes.data(), sizeof column.codes);
    next += column.count;
    v = column.next_v;
  } while (next <= end);
  phase_ = dda.phase;
  v_ = static_cast<std::uint8_t>(v);
  count_ = static_cast<std::uint16_t>(next - codes_.data());
}

}  // namespace iog::grid
