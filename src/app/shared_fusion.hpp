// The fusing of a frame's packets, slice by slice, by several cores (app/parts_fusion.hpp).
//
//     packets -> [FrameParts] parts -> [PartsFusion] tiles of a part            one round
//                                      tiles of all parts -> the frame's grid    one round
//                                      tiles of up to six slices -> their cells  one round
//
// Copying writes what it has not read, so an item can be done again from its start.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/frame_engine.hpp"
#include "app/frame_packets.hpp"
#include "app/frame_parts.hpp"
#include "app/parts_fusion.hpp"
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

// Holds 72 MB: belongs into static memory.
class SharedFusion {
 public:
  // vehicle outlives it.
  explicit SharedFusion(const vehicle::Vehicle& vehicle) : fused_(vehicle) {}

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

  // Adds them to the frame's grid, which nothing was added to before the first round.
  void join(const work::Crew& crew, grid::JoinedGrid& grid);

  // Of those that were fused: packets that are in no slice.
  [[nodiscard]] std::uint32_t packets_nowhere() const { return packets_nowhere_; }

  // The next slices of those that were fused, for the window, in their order; empty behind the
  // last. The cells are valid until the next call.
  [[nodiscard]] std::span<const FusedSlice> next_slices(const work::Crew& crew);

 private:
  using JoinedTile = std::array<index::OccupancyIndex, geometry::kTileCells>;

  // Of a slice: its parts among those of the round.
  struct Parts {
    std::size_t first = 0;
    std::size_t end = 0;
  };

  static constexpr std::size_t kMostSlices = window::FrameEvidence::kMostAtOnce;

  void find_slices();
  void copy_tile(std::size_t tile, std::size_t slice, JoinedTile& memory);

  PartsFusion fused_;
  std::array<window::SliceCells, kMostSlices> cells_{};
  alignas(32) std::array<JoinedTile, hal::kMaxCores> joined_tiles_{};  // by core
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
