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

bool SharedFusion::is_known(std::size_t tile) const {
  return std::any_of(results_.begin() + static_cast<std::ptrdiff_t>(first_),
                     results_.begin() + static_cast<std::ptrdiff_t>(end_),
                     [tile](const Result& result) { return result.tiles.is_known(tile); });
}

}  // namespace iog::app
