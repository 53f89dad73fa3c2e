#include "app/shared_fusion.hpp"

namespace iog::app {

bool SharedFusion::fuse_next(const work::Crew& crew, FrameEngine& frame) {
  round_ = parts_.next_round();
  fused_.fuse(crew, parts_, round_, *packets_, frame);
  for (const FramePart& part : round_) {
    packets_nowhere_ += part.group == FrameSlices::kNowhere ? part.packets() : 0U;
  }
  shown_ = 0;
  return !round_.empty();
}

void SharedFusion::join(const work::Crew& crew, grid::JoinedGrid& grid) {
  fused_.join(crew, round_.size(), grid, is_first_round_);
  is_first_round_ = false;
}

std::span<const FusedSlice> SharedFusion::next_slices(const work::Crew& crew) {
  find_slices();
  const std::span cells = std::span(cells_).first(slice_count_);
  if (cells.empty()) {
    return {};
  }
  std::ranges::for_each(cells, &window::SliceCells::begin);
  crew.share(geometry::kTilesPerSide, [this](std::size_t row, std::size_t core) {
    for (std::size_t slice = 0; slice < slice_count_; ++slice) {
      for (std::size_t column = 0; column < geometry::kTilesPerSide; ++column) {
        copy_tile(row * geometry::kTilesPerSide + column, slice, joined_tiles_[core]);
      }
    }
  });
  std::ranges::for_each(cells, &window::SliceCells::note_all);
  return std::span(slices_).first(slice_count_);
}

// The next ones of the round. What has no place comes last.
void SharedFusion::find_slices() {
  slice_count_ = 0;
  while (slice_count_ < kMostSlices && shown_ < round_.size() &&
         round_[shown_].group != FrameSlices::kNowhere) {
    FusedSlice& slice = slices_[slice_count_];
    slice = {.group = round_[shown_].group, .cells = &cells_[slice_count_]};
    slice_parts_[slice_count_].first = shown_;
    for (; shown_ < round_.size() && round_[shown_].group == slice.group; ++shown_) {
      slice.packets += round_[shown_].packets();
    }
    slice_parts_[slice_count_].end = shown_;
    ++slice_count_;
  }
}

// The tile's indexes of all parts of the slice, joined in the memory if they are several.
void SharedFusion::copy_tile(std::size_t tile, std::size_t slice, JoinedTile& memory) {
  const grid::FrameTiles* only = nullptr;
  bool is_joined = false;
  for (std::size_t part = slice_parts_[slice].first; part < slice_parts_[slice].end; ++part) {
    const grid::FrameTiles& tiles = fused_.tiles(part);
    if (!tiles.is_known(tile)) {
      continue;
    }
    if (only != nullptr && !is_joined) {
      std::ranges::copy(only->tile(tile), memory.begin());
      is_joined = true;
    }
    if (is_joined) {
      grid::join(memory, tiles.tile(tile));
    }
    only = &tiles;
  }
  if (only == nullptr) {
    cells_[slice].leave(tile);
  } else {
    cells_[slice].copy(tile, is_joined ? grid::JoinedGrid::TileIndexes(memory) : only->tile(tile));
  }
}

}  // namespace iog::app
