// What a receiver knows of the world around the car at any moment: of each tile of the window the
// last classes that arrived, and how old they are. A tile whose newest state was lost is stale and
// is never shown as fresh.
//
// Tiles are by slot, so they stay where they are while the window moves; one that has left it is
// gone. What was known before the target lost its way is gone, too, and likewise where nobody knows
// whether it has: after a frame of which no message about classes came.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/frames/grid_frame.hpp"

namespace iog::tools {

// The causes after which the window began as unknown (docs/spec.md 3.9).
inline constexpr std::uint16_t kForgettingCauses =
    stream::kCauseLost | stream::kCauseJump | stream::kCauseRestart | stream::kCauseContradicted |
    stream::kCauseDrifting;

class LiveClasses {
 public:
  using Tile = std::array<std::int8_t, tile_coding::kTileBytes>;

  // The next frame, in order, as FrameAssembler hands them over. Of another run nothing is kept.
  void take(const GridFrame& frame);

  // To be called when the target has been silent: nothing that is known is of now.
  void forget();

  // Where the newest frame's window is. Nothing if no classes have arrived since all was forgotten.
  [[nodiscard]] const std::optional<stream::ClassWindow>& window() const { return window_; }

  [[nodiscard]] std::uint16_t cell_mm() const { return cell_mm_; }
  [[nodiscard]] window::Extent extent() const { return extent_; }

  // How many frames older than the newest frame the tile's cells are; 0 is fresh. Nothing if none
  // of them is known to be of where the window now is.
  [[nodiscard]] std::optional<std::uint32_t> age_of(std::size_t slot) const;

  // How many frames before the newest one the tile was decided; 255: that many or more. Nothing as
  // above.
  [[nodiscard]] std::optional<std::uint8_t> decided_ago(std::size_t slot) const;

  // Tiles of the window that are older than the newest frame, or missing.
  [[nodiscard]] std::size_t stale_tiles() const;

  // Class bytes row by row; 0 where age_of() says nothing.
  [[nodiscard]] const Tile& tile(std::size_t slot) const { return tiles_.at(slot); }

 private:
  struct Kept {
    std::uint32_t frame = 0;      // in which it arrived
    std::uint8_t age_frames = 0;  // that it had then
    window::TileNumber place{};
  };

  void move_to(const ClassGrid& classes);
  void forget_tile(std::size_t slot);

  std::vector<Tile> tiles_ = std::vector<Tile>(geometry::kTileCount);
  std::array<std::optional<Kept>, geometry::kTileCount> kept_{};
  std::optional<stream::ClassWindow> window_;
  std::uint16_t cell_mm_ = geometry::kCellMm;
  window::Extent extent_{};
  std::uint32_t newest_frame_ = 0;
  std::uint32_t run_number_ = 0;
};

}  // namespace iog::tools
