// The fusing of a frame's packets by several cores: each with a fusion of its own.
//
//     packets -> [FrameParts] parts -> any core's fusion -> tiles of a part      one round
//                                      tiles of all parts -> the frame's grid    one round
//                                      tiles of a slice -> whoever asks          one round each
//
// Saturated sums of one sign do not mind in which grid they were begun (grid/joined_grid.hpp), so
// which core has which part does not show. A part that a core has left can be fused again from its
// start: what it wrote is its core's fusion, which nobody uses again, and its own place here.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/frame_engine.hpp"
#include "app/frame_packets.hpp"
#include "app/frame_parts.hpp"
#include "grid/frame_tiles.hpp"
#include "grid/joined_grid.hpp"
#include "hal/cores.hpp"
#include "work/crew.hpp"

namespace iog::app {

// Holds 63 MB: belongs into static memory.
class SharedFusion {
 public:
  // vehicle outlives it.
  explicit SharedFusion(const vehicle::Vehicle& vehicle)
      : fusions_{grid::FrameFusion(vehicle), grid::FrameFusion(vehicle),
                 grid::FrameFusion(vehicle)},
        vehicle_(&vehicle) {}

  // A frame's packets, of which so many groups have a place.
  void begin(FramePackets& packets, std::size_t placed_groups) {
    packets_ = &packets;
    parts_.deal(packets.packets(), placed_groups);
    is_first_round_ = true;
  }

  // Fuses the next slices, by core 0 in its frame's fusion, and counts their points there. Whether
  // there were any.
  [[nodiscard]] bool fuse_next(const work::Crew& crew, FrameEngine& frame);

  // Adds them to the frame's grid, which nothing was added to before the first round. Later ones
  // add to what is there, which cannot be done again from its start: core 0 does it alone.
  void join(const work::Crew& crew, grid::JoinedGrid& grid);

  // Calls visit(group, packets) for each slice of the round, in their order: how many packets were
  // fused. Then for_each_tile(visit) shows its tiles.
  template <typename Visit>
  void for_each_slice(Visit&& visit) {
    for (std::size_t end = 0; end < round_.size();) {
      first_ = end;
      std::uint32_t packets = 0;
      while (end < round_.size() && round_[end].group == round_[first_].group) {
        packets += static_cast<std::uint32_t>(round_[end].end - round_[end].first);
        ++end;
      }
      end_ = end;
      visit(std::size_t{round_[first_].group}, packets);
    }
  }

  // Any core calls visit(tile, indexes) for each tile of the slice at hand in which something is
  // known, in no order, and again if a core is lost. The indexes are valid during the call.
  template <typename Visit>
  void share_tiles(const work::Crew& crew, Visit visit) {
    crew.share(work::items_of(geometry::kTileCount, kTilesInEach),
               [this, &visit](std::size_t item, std::size_t core) {
                 for (std::size_t i = 0; i < kTilesInEach; ++i) {
                   show(item * kTilesInEach + i, joined_tiles_[core], visit);
                 }
               });
  }

  // Core 0 calls visit(tile) for each of these, in rising order.
  template <typename Visit>
  void for_each_tile(Visit&& visit) const {
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      if (is_known(tile)) {
        visit(tile);
      }
    }
  }

 private:
  // What fusing a part makes. Whoever does it writes it.
  struct Result {
    FrameEngine::Fates fates{};
    grid::FrameTiles tiles;
  };

  using JoinedTile = std::array<index::OccupancyIndex, geometry::kTileCells>;

  static constexpr std::size_t kTilesInEach = 16;
  static_assert(geometry::kTileCount % kTilesInEach == 0);

  void fuse(std::size_t item, grid::FrameFusion& fusion);
  void join_row(std::size_t row, grid::JoinedGrid& grid) const;
  [[nodiscard]] bool is_known(std::size_t tile) const;

  // The tile's indexes of all parts of the slice at hand, joined in the memory if they are several.
  template <typename Visit>
  void show(std::size_t tile, JoinedTile& memory, Visit&& visit) const {
    const grid::FrameTiles* only = nullptr;
    bool is_joined = false;
    for (std::size_t part = first_; part < end_; ++part) {
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
    if (only != nullptr) {
      visit(tile, is_joined ? grid::JoinedGrid::TileIndexes(memory) : only->tile(tile));
    }
  }

  std::array<grid::FrameFusion, hal::kMaxCores - 1> fusions_;  // of the helpers
  std::array<Result, FrameParts::kMostOfARound> results_{};
  alignas(32) std::array<JoinedTile, hal::kMaxCores> joined_tiles_{};  // by core
  const vehicle::Vehicle* vehicle_;
  FramePackets* packets_ = nullptr;
  FrameParts parts_;
  std::span<const FramePart> round_;
  bool is_first_round_ = true;
  // The parts of the slice at hand.
  std::size_t first_ = 0;
  std::size_t end_ = 0;
};

}  // namespace iog::app
