// The slices of a round of parts (fusion/shared_fusion.hpp), as the window wants them: the tiles of
// each slice's parts joined, up to six slices at a time.
//
// Copying writes what it has not read, so an item can be done again from its start.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fusion/shared_fusion.hpp"
#include "hal/cores.hpp"
#include "placing/frame_evidence.hpp"
#include "placing/slice_cells.hpp"
#include "work/crew.hpp"

namespace iog::fusion {

// A slice: the number of its group, and its cells.
struct FusedSlice {
  std::uint8_t group = 0;
  const placing::SliceCells* cells = nullptr;
};

// Holds 7 MB: belongs into static memory.
class FusedSlices {
 public:
  // Of one core, which hands over slice after slice: the memory for one, with whatever is in it.
  [[nodiscard]] placing::SliceCells& one() { return cells_[0]; }

  // The fusion has fused a round, and will not fuse the next before the last slice was shown.
  void begin(const SharedFusion& fusion) {
    fusion_ = &fusion;
    shown_ = 0;
  }

  // The next slices, in their order; empty behind the last. Valid until the next call.
  [[nodiscard]] std::span<const FusedSlice> next(const work::Crew& crew);

 private:
  struct JoinedTile {
    std::array<index::OccupancyIndex, geometry::kTileCells> indexes{};
    grid::TileBits low_and_tall{};
  };

  // Of a slice: its parts among those of the round.
  struct Parts {
    std::size_t first = 0;
    std::size_t end = 0;
  };

  static constexpr std::size_t kMostSlices = placing::FrameEvidence::kMostAtOnce;

  void find_slices();
  void copy_tile(std::size_t tile, std::size_t slice, JoinedTile& memory);

  std::array<placing::SliceCells, kMostSlices> cells_{};
  alignas(32) std::array<JoinedTile, hal::kMaxCores> joined_tiles_{};  // by core
  const SharedFusion* fusion_ = nullptr;
  std::size_t shown_ = 0;  // parts of the round
  // The slices at hand.
  std::size_t slice_count_ = 0;
  std::array<FusedSlice, kMostSlices> slices_{};
  std::array<Parts, kMostSlices> slice_parts_{};
};

}  // namespace iog::fusion
