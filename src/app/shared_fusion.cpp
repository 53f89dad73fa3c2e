#include "app/shared_fusion.hpp"

#include <algorithm>

namespace iog::app {

bool SharedFusion::fuse_next(const work::Crew& crew, FrameEngine& frame) {
  round_ = parts_.next_round();
  crew.share(round_.size(), [this, &frame](std::size_t item, std::size_t core) {
    fuse(item, core == 0 ? frame.fusion() : fusions_[core - 1]);
  });
  for (const Result& result : std::span(results_).first(round_.size())) {
    frame.count(result.fates);
  }
  for (const FramePart& part : round_) {
    packets_nowhere_ += part.group == FrameSlices::kNowhere ? part.packets() : 0U;
  }
  shown_ = 0;
  return !round_.empty();
}

void SharedFusion::join(const work::Crew& crew, grid::JoinedGrid& grid) {
  const work::Crew alone;
  (is_first_round_ ? crew : alone)
      .share(geometry::kTilesPerSide,
             [this, &grid](std::size_t row, std::size_t /*core*/) { join_row(row, grid); });
  is_first_round_ = false;
}

void SharedFusion::fuse(std::size_t item, grid::FrameFusion& fusion) {
  Result& result = results_[item];
  result.fates = {};
  for (const std::uint16_t number : parts_.packets_of(round_[item])) {
    const KeptPacket& packet = packets_->packets()[number];
    FrameEngine::add_points_to(fusion, vehicle_->sensors[packet.sensor], packets_->decoded(packet),
                               result.fates);
  }
  fusion.finish();
  result.tiles.take(fusion);
}

// In the first round what is there is of nobody who has ended his item.
void SharedFusion::join_row(std::size_t row, grid::JoinedGrid& grid) const {
  for (std::size_t column = 0; column < geometry::kTilesPerSide; ++column) {
    const std::size_t tile = row * geometry::kTilesPerSide + column;
    if (is_first_round_) {
      grid.forget(tile);
    }
    for (const Result& result : std::span(results_).first(round_.size())) {
      if (result.tiles.is_known(tile)) {
        grid.add(tile, result.tiles.tile(tile));
      }
    }
  }
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
    const grid::FrameTiles& tiles = results_[part].tiles;
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
