// The fusing of a frame's packets by several cores: each with a fusion of its own.
//
//     packets -> [FrameParts] parts -> any core's fusion -> tiles of a part      one round
//                                      tiles of all parts -> the frame's grid    one round
//                                      tiles of some slices -> their cells       one round each
//
// Saturated sums of one sign do not mind in which grid they were begun (grid/joined_grid.hpp), so
// which core has which part does not show. A part that a core has left can be fused again from its
// start: what it wrote is its core's fusion, which nobody uses again, and its own place here.
// Joining and copying write what they have not read.
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
#include "window/frame_evidence.hpp"
#include "window/slice_cells.hpp"
#include "work/crew.hpp"

namespace iog::app {

// A slice, for the window: the number of its group, of how many packets it was fused, and its
// cells.
struct FusedSlice {
  std::size_t group = 0;
  std::uint32_t packets = 0;
  const window::SliceCells* cells = nullptr;
};

// Holds 70 MB: belongs into static memory.
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
    packets_nowhere_ = 0;
  }

  // Fuses the next slices, by core 0 in its frame's fusion, and counts their points there. Whether
  // there were any.
  [[nodiscard]] bool fuse_next(const work::Crew& crew, FrameEngine& frame);

  // Adds them to the frame's grid, which nothing was added to before the first round. Later ones
  // add to what is there, which cannot be done again from its start: core 0 does it alone.
  void join(const work::Crew& crew, grid::JoinedGrid& grid);

  // Of those that were fused: packets that are in no slice.
  [[nodiscard]] std::uint32_t packets_nowhere() const { return packets_nowhere_; }

  // The next slices of those that were fused, for the window, in their order; empty behind the
  // last. The cells are valid until the next call.
  [[nodiscard]] std::span<const FusedSlice> next_slices(const work::Crew& crew);

 private:
  // What fusing a part makes. Whoever does it writes it.
  struct Result {
    FrameEngine::Fates fates{};
    grid::FrameTiles tiles;
  };

  using JoinedTile = std::array<index::OccupancyIndex, geometry::kTileCells>;

  // Of a slice: its parts among those of the round.
  struct Parts {
    std::size_t first = 0;
    std::size_t end = 0;
  };

  static constexpr std::size_t kMostSlices = window::FrameEvidence::kMostAtOnce;

  void fuse(std::size_t item, grid::FrameFusion& fusion);
  void join_row(std::size_t row, grid::JoinedGrid& grid) const;
  void find_slices();
  void copy_tile(std::size_t tile, std::size_t slice, JoinedTile& memory);

  std::array<grid::FrameFusion, hal::kMaxCores - 1> fusions_;  // of the helpers
  std::array<Result, FrameParts::kMostOfARound> results_{};
  std::array<window::SliceCells, kMostSlices> cells_{};
  alignas(32) std::array<JoinedTile, hal::kMaxCores> joined_tiles_{};  // by core
  const vehicle::Vehicle* vehicle_;
  FramePackets* packets_ = nullptr;
  FrameParts parts_;
  std::span<const FramePart> round_;
  bool is_first_round_ = true;
  std::uint32_t packets_nowhere_ = 0;
  std::size_t shown_ = 0;  // parts of the round
  // The slices at hand.
  std::size_t slice_count_ = 0;
  std::array<FusedSlice, kMostSlices> slices_{};
  std::array<Parts, kMostSlices> slice_parts_{};
};

}  // namespace iog::app
