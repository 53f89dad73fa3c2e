// Prepares the slices fused in a round (fusion/shared_fusion.hpp) for registration in the window.
// This class joins the tiles of each slice's parts, for up to six slices at a time.
//
// A task that copies tiles never reads its own output. If a core is lost, its task can therefore be
// repeated from the start.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fusion/shared_fusion.hpp"
#include "hal/cores.hpp"
#include "health/constants.hpp"
#include "placing/frame_evidence.hpp"
#include "placing/slice_cells.hpp"
#include "work/crew.hpp"

namespace iog::fusion {

// The group number and the cells of a slice.
struct FusedSlice {
  std::uint8_t group = 0;
  const placing::SliceCells* cells = nullptr;
};

// A FusedSlices object uses 7 MB, so it must be in static memory.
class FusedSlices {
 public:
  explicit FusedSlices(const geometry::Grid& grid) {
    for (placing::SliceCells& cells : cells_) {
      cells.take_shape(grid);
    }
  }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    for (const placing::SliceCells& cells : cells_) {
      health::visit_constants(visit, cells.shape(), cells.tile_rows());
    }
  }

  // Returns memory for one slice. Only one core may use this memory. The initial content is
  // arbitrary.
  [[nodiscard]] placing::SliceCells& one() { return cells_[0]; }

  // Starts reading a finished round of the fusion. The fusion may begin the next round only after
  // next() has returned the last slice.
  void begin(const SharedFusion& fusion) {
    fusion_ = &fusion;
    shown_ = 0;
  }

  // Returns the next slices in order, or an empty span after the last slice. The result is valid
  // until the next call.
  [[nodiscard]] std::span<const FusedSlice> next(const work::Crew& crew);

 private:
  struct JoinedTile {
    std::array<index::OccupancyIndex, geometry::kTileCells> indexes{};
    grid::TileBits low_and_tall{};
  };

  // The slice's parts, as a range within the round.
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
  std::size_t shown_ = 0;  // the number of the round's parts returned so far
  // The current slices.
  std::size_t slice_count_ = 0;
  std::array<FusedSlice, kMostSlices> slices_{};
  std::array<Parts, kMostSlices> slice_parts_{};
};

}  // namespace iog::fusion
