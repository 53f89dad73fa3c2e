#include "grid/block_path.hpp"

#include <algorithm>

#include "require/require.hpp"

namespace iog::grid {

using vehicle::BeamLine;

void BlockPath::begin(const BeamLine& line) {
  start_ = line.cell({});
  require(vehicle::kGridArea.contains(start_));
  orientation_ = {.is_steep = line.y().length() > line.x().length(),
                  .x_is_negative = line.x().step() < 0,
                  .y_is_negative = line.y().step() < 0};
  masks_ = &kShapeMasks[orientation_.number()];
  const std::int32_t x_gain = vehicle::kResolution * static_cast<std::int32_t>(line.y().length());
  const std::int32_t y_gain = vehicle::kResolution * static_cast<std::int32_t>(line.x().length());
  gain_ = orientation_.is_steep ? y_gain : x_gain;
  loss_ = orientation_.is_steep ? x_gain : y_gain;
  error_ = orientation_.is_steep ? -line.error({}) : line.error({});
  const std::int32_t y_stride = line.y().step() * kBlockStride;
  u_stride_ = static_cast<std::int16_t>(orientation_.is_steep ? y_stride : line.x().step());
  v_stride_ = static_cast<std::int16_t>(orientation_.is_steep ? line.x().step() : y_stride);
  const auto into_block = [](std::int32_t coordinate, bool is_negative) {
    const auto inner = static_cast<std::uint32_t>(coordinate % kBlockSide);
    return static_cast<std::uint8_t>(is_negative ? kBlockSide - 1 - inner : inner);
  };
  x_in_block_ = into_block(start_.x, orientation_.x_is_negative);
  y_in_block_ = into_block(start_.y, orientation_.y_is_negative);
  x_ = start_.x / kBlockSide;
  y_ = start_.y / kBlockSide;
  tile_along_x_ = static_cast<std::int8_t>(line.x().step());
  tile_along_y_ = static_cast<std::int8_t>(line.y().step() * kTilesPerSide);
  tile_entries_[0] = 0;
  tile_entries_[1] = kNoTile;
  tile_count_ = 1;
  find_first_block();
}

// The line begins anywhere in its first block: cell by cell.
void BlockPath::find_first_block() {
  std::uint32_t u = orientation_.is_steep ? y_in_block_ : x_in_block_;
  std::uint32_t v = orientation_.is_steep ? x_in_block_ : y_in_block_;
  first_cells_ = {};
  while (u < kBlockSide && v < kBlockSide) {
    first_cells_.bytes[orientation_.inner(u, v)] = -1;
    if (error_ > 0) {
      error_ -= loss_;
      ++v;
    } else {
      error_ += gain_;
      ++u;
    }
  }
  const bool leaves_above = v == kBlockSide;
  codes_[0] = leaves_above ? 1 : 0;
  entry_ = leaves_above ? entered_from_below(u) : entered_from_the_left(v);
  count_ = 1;
}

// What the bits of a block say beyond the border by which the line leaves it is about the next one,
// and its passage does not look at them. The term at the end fits its range, what it is summed up
// from need not.
void BlockPath::find_up_to(std::uint32_t block) {
  require(block < kMaxBlocks);
  while (count_ <= block) {
    const bool is_above = (codes_[count_ - 1] & 1U) != 0;
    const bool along_x = is_above == orientation_.is_steep;
    if (along_x) {
      leave(x_, orientation_.x_is_negative, false);
    } else {
      leave(y_, orientation_.y_is_negative, true);
    }
    std::int32_t error = error_;
    std::uint32_t bits = 0;
    for (std::uint32_t column = 0; column < 4; ++column) {
      if (error > 0) {
        bits |= 1U << column;
        error -= loss_;
      }
      error += gain_;
    }
    const BlockPassage& passage = kPassages[shape_of(entry_, bits)];
    codes_[count_] = passage.code;
    error_ = static_cast<std::int32_t>(static_cast<std::uint32_t>(error_) +
                                       passage.u_borders * static_cast<std::uint32_t>(gain_) -
                                       passage.v_borders * static_cast<std::uint32_t>(loss_));
    entry_ = passage.next_entry;
    ++count_;
  }
}

// The last block that was found lies beside the next one, along this coordinate.
void BlockPath::leave(std::int32_t& coordinate, bool is_negative, bool is_y) {
  const std::int32_t from = coordinate;
  coordinate += is_negative ? -1 : 1;
  if (from / kBlocksPerTile != coordinate / kBlocksPerTile) {
    tile_entries_[tile_count_] = static_cast<TileEntry>(2 * count_ + (is_y ? 1U : 0U));
    ++tile_count_;
    tile_entries_[tile_count_] = kNoTile;
  }
}

std::uint32_t BlockPath::count_common(const BlockPath& other, std::uint32_t at_most) const {
  if (first_cells_ != other.first_cells_ || codes_[0] != other.codes_[0] ||
      masks_ != other.masks_) {
    return 0;
  }
  const auto mine = std::span(codes_).first(at_most);
  return static_cast<std::uint32_t>(std::ranges::mismatch(mine, other.codes_).in1 - mine.begin());
}

}  // namespace iog::grid
