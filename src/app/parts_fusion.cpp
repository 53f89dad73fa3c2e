#include "app/parts_fusion.hpp"

#include "require/require.hpp"

namespace iog::app {

void PartsFusion::fuse(const work::Crew& crew, const FrameParts& dealt,
                       std::span<const FramePart> parts, FramePackets& packets, FrameEngine& frame,
                       std::size_t first) {
  require(parts.size() <= kPlaces - first);
  crew.share(parts.size(), [&](std::size_t item, std::size_t core) {
    fuse_part(dealt.packets_of(parts[item]), packets,
              core == 0 ? frame.fusion() : fusions_[core - 1], results_[first + item]);
  });
  for (const Result& result : std::span(results_).subspan(first, parts.size())) {
    frame.count(result.fates);
  }
}

void PartsFusion::fuse_part(std::span<const std::uint16_t> numbers, FramePackets& packets,
                            grid::FrameFusion& fusion, Result& result) const {
  result.fates = {};
  for (const std::uint16_t number : numbers) {
    const KeptPacket& packet = packets.packets()[number];
    FrameEngine::add_points_to(fusion, vehicle_->sensors[packet.sensor], packets.decoded(number),
                               result.fates);
  }
  fusion.carve_waiting();
  result.marks = fusion.marks();
  fusion.finish();
  result.tiles.take(fusion);
}

std::size_t PartsFusion::marks(std::size_t first, std::size_t count) const {
  std::size_t marks = 0;
  for (const Result& result : std::span(results_).subspan(first, count)) {
    marks += result.marks;
  }
  return marks;
}

void PartsFusion::join(const work::Crew& crew, std::size_t count, grid::JoinedGrid& grid,
                       bool is_first) const {
  const work::Crew alone;
  (is_first ? crew : alone)
      .share(geometry::kTilesPerSide,
             [&](std::size_t row, std::size_t /*core*/) { join_row(row, count, grid, is_first); });
}

void PartsFusion::join_row(std::size_t row, std::size_t count, grid::JoinedGrid& grid,
                           bool is_first) const {
  for (std::size_t column = 0; column < geometry::kTilesPerSide; ++column) {
    const std::size_t tile = row * geometry::kTilesPerSide + column;
    if (is_first) {
      grid.forget(tile);
    }
    for (const Result& result : std::span(results_).first(count)) {
      if (result.tiles.is_known(tile)) {
        grid.add(tile, result.tiles.tile(tile));
      }
    }
  }
}

}  // namespace iog::app
