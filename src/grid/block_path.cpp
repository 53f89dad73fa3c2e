#include "grid/block_path.hpp"

#include "require/require.hpp"

namespace iog::grid {

using vehicle::BeamLine;

void BlockPath::begin(const BeamLine& line) {
  start_ = line.cell({});
  require(geometry::kGridArea.contains(start_));
  orientation_ = {.is_steep = line.y().length() > line.x().length(),
                  .x_is_negative = line.x().step() < 0,
                  .y_is_negative = line.y().step() < 0};
  masks_ = &kShapeMasks[orientation_.number()];
  const std::int32_t x_gain = geometry::kResolution * static_cast<std::int32_t>(line.y().length());
  const std::int32_t y_gain = geometry::kResolution * static_cast<std::int32_t>(line.x().length());
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
  const auto to_tile = [](std::int32_t coordinate, bool is_negative) {
    const std::int32_t in_tile = coordinate / kBlockSide % kBlocksPerTile;
    return static_cast<std::uint32_t>(is_negative ? in_tile + 1 : kBlocksPerTile - in_tile);
  };
  const std::uint32_t to_tile_x = to_tile(start_.x, orientation_.x_is_negative);
  const std::uint32_t to_tile_y = to_tile(start_.y, orientation_.y_is_negative);
  blocks_to_tile_u_ = orientation_.is_steep ? to_tile_y : to_tile_x;
  blocks_to_tile_v_ = orientation_.is_steep ? to_tile_x : to_tile_y;
  constexpr std::int32_t kTileRow = geometry::kTilesPerSide;
  tile_along_x_ = static_cast<std::int16_t>(line.x().step());
  tile_along_y_ = static_cast<std::int16_t>(line.y().step() * kTileRow);
  tile_entries_[0] = 0;
  tile_entries_[1] = kNoTile;
  tile_count_ = 1;
  find_first_block();
}

// The line can begin anywhere in its first block, so that block is found cell by cell.
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

// Each round of the loop finds one block. It looks at the error term of the walk column by column.
// For a block that is entered at (0, 1), with a term that is in turn below and above 0:
//
//     v
//     3 | .  .  .  # |--> the next block is entered at (0, 3)
//     2 | .  #  #  # |
//     1 | #  #  .  . |    entry 1 and bits 0, 1, 0, 1 are the shape; kPassages says the rest
//     0 | .  .  .  . |
//  ahead  -  +  -  +      above 0, the line crosses a border of v in this column
//
// If the line leaves the block through its upper border, the bits of further columns say something
// of the next block; the passage does not look at them. The error term at the end fits its range,
// although the terms that it is summed up from need not. Members are copied into registers, because
// the compiler cannot know that storing a code does not change one of them.
void BlockPath::find_up_to(std::uint32_t block) {
  require(block < kMaxBlocks);
  const std::int32_t gain = gain_;
  const std::int32_t loss = loss_;
  std::int32_t error = error_;
  BlockEntry entry = entry_;
  std::uint32_t to_tile_u = blocks_to_tile_u_;
  std::uint32_t to_tile_v = blocks_to_tile_v_;
  BlockCode code = codes_[count_ - 1];
  for (std::uint32_t number = count_; number <= block; ++number) {
    const bool leaves_by_v = (code & 1U) != 0;
    std::uint32_t& to_tile = leaves_by_v ? to_tile_v : to_tile_u;
    --to_tile;
    if (to_tile == 0) {
      to_tile = kBlocksPerTile;
      note_tile(number, leaves_by_v != orientation_.is_steep);
    }
    std::int32_t ahead = error;
    std::uint32_t bits = 0;
    for (std::uint32_t column = 0; column < kBlockSide; ++column) {
      if (ahead > 0) {
        bits |= 1U << column;
        ahead -= loss;
      }
      ahead += gain;
    }
    const BlockPassage passage = kPassages[shape_of(entry, bits)];
    code = passage.code;
    codes_[number] = code;
    entry = passage.next_entry;
    error = static_cast<std::int32_t>(static_cast<std::uint32_t>(error) +
                                      passage.u_borders * static_cast<std::uint32_t>(gain) -
                                      passage.v_borders * static_cast<std::uint32_t>(loss));
  }
  error_ = error;
  entry_ = entry;
  blocks_to_tile_u_ = to_tile_u;
  blocks_to_tile_v_ = to_tile_v;
  count_ = block + 1;
}

void BlockPath::note_tile(std::uint32_t first_block, bool along_y) {
  tile_entries_[tile_count_] = static_cast<TileEntry>(2 * first_block + (along_y ? 1U : 0U));
  ++tile_count_;
  tile_entries_[tile_count_] = kNoTile;
}

}  // namespace iog::grid
