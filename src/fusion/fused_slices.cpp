#include "fusion/fused_slices.hpp"

#include <algorithm>

namespace iog::fusion {

std::span<const FusedSlice> FusedSlices::next(const work::Crew& crew) {
  find_slices();
  const std::span cells = std::span(cells_).first(slice_count_);
  if (cells.empty()) {
    return {};
  }
  std::ranges::for_each(cells, &placing::SliceCells::begin);
  crew.share(geometry::kTilesPerSide, [this](std::size_t row, std::size_t core) {
    for (std::size_t slice = 0; slice < slice_count_; ++slice) {
      for (std::size_t column = 0; column < geometry::kTilesPerSide; ++column) {
        copy_tile(row * geometry::kTilesPerSide + column, slice, joined_tiles_[core]);
      }
    }
  });
  crew.share(slice_count_,
             [cells](std::size_t slice, std::size_t /*core*/) { cells[slice].note_all(); });
  return std::span(slices_).first(slice_count_);
}

// Collects the next slices of the round. Parts that are not registered come last.
void FusedSlices::find_slices() {
  const std::span<const FramePart> round = fusion_->round();
  slice_count_ = 0;
  while (slice_count_ < kMostSlices && shown_ < round.size() &&
         round[shown_].group != FrameSlices::kNowhere) {
    const std::uint8_t group = round[shown_].group;
    Parts& parts = slice_parts_[slice_count_];
    parts.first = shown_;
    while (shown_ < round.size() && round[shown_].group == group) {
      ++shown_;
    }
    parts.end = shown_;
    slices_[slice_count_] = {.group = group, .cells = &cells_[slice_count_]};
    ++slice_count_;
  }
}

// Copies the indexes of a tile from the slice's parts. If several parts know the tile, they are
// joined in `memory`.
void FusedSlices::copy_tile(std::size_t tile, std::size_t slice, JoinedTile& memory) {
  const FrameTiles* only = nullptr;
  bool is_joined = false;
  for (std::size_t part = slice_parts_[slice].first; part < slice_parts_[slice].end; ++part) {
    const FrameTiles& tiles = fusion_->tiles(part);
    if (!tiles.is_known(tile)) {
      continue;
    }
    if (only != nullptr && !is_joined) {
      std::ranges::copy(only->tile(tile), memory.indexes.begin());
      memory.low_and_tall = only->low_and_tall(tile);
      is_joined = true;
    }
    if (is_joined) {
      memory.low_and_tall =
          join(memory.indexes, memory.low_and_tall, tiles.tile(tile), tiles.low_and_tall(tile));
      join(memory.indexes, tiles.tile(tile));
    }
    only = &tiles;
  }
  if (only == nullptr) {
    cells_[slice].leave(tile);
  } else if (is_joined) {
    cells_[slice].copy(tile, memory.indexes, memory.low_and_tall);
  } else {
    cells_[slice].copy(tile, only->tile(tile), only->low_and_tall(tile));
  }
}

}  // namespace iog::fusion
