// The fusion of one frame: beams in, a grid of occupancy indexes out.
//
// Contract section 3. The frame starts from a grid of zeros. Saturated sums of negative indexes
// commute, so the order in which beams carve does not show, and beams of one azimuth wait for one
// another: those of one line, or of lines through the same cells, are carved together. Marks wait
// in a list until finish(), for the same reason: marks commute among themselves, but not with
// carving. Whatever order the packets of a frame came in, the grid is the same to the byte.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "grid/beam_lines.hpp"
#include "grid/block_grid.hpp"
#include "grid/frame_view.hpp"
#include "grid/free_steps.hpp"
#include "index/occupancy_index.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// One cell that a scan point marks.
struct Mark {
  std::uint32_t cell : 25;  // y * geometry::kCellsPerSide + x
  std::uint32_t index : 7;  // 1 ... 127
};
static_assert(geometry::kCellCount <= (std::size_t{1} << 25) && sizeof(Mark) == 4);

// The most marks of one frame: 256 KiB of them, enough for a dual-return VLP-16 turn (57,600
// points). fits() tells before a packet is fused whether its points still find room.
inline constexpr std::size_t kMaxMarks = 65'536;

class FrameFusion {
 public:
  // vehicle outlives the fusion.
  explicit FrameFusion(const vehicle::Vehicle& vehicle)
      : lines_(vehicle.sensors), vehicle_(&vehicle) {}

  // Whether that many points of this sensor can still be marked in this frame.
  [[nodiscard]] bool fits(const vehicle::Sensor& sensor, std::uint32_t points) const;

  // Carves the beam of this point, now or later, and remembers its mark. The sensor is one of the
  // vehicle's; the point's layer and azimuth are those of its format. Only if fits() said so.
  vehicle::Fate add(const vehicle::Sensor& sensor, const lidar::ScanPoint& point);

  // Carves the beams that still wait.
  void carve_waiting();

  // The same, and applies the marks by the vehicle's fusion rule. Once per frame, after its last
  // point.
  void finish();

  // The grid, complete after finish(), until it is cleared.
  [[nodiscard]] FrameView view() const { return FrameView(grid_); }

  // Shows the frame tile by tile and clears it: visit(number, cells) for each tile in which
  // something is known, in rising order. The cells, row by row from the lowest y, are valid during
  // the call.
  template <typename Visit>
  void release(Visit&& visit) {
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      if (!grid_.is_touched(tile)) {
        continue;
      }
      const bool is_known = grid_.copy_tile(tile, tile_cells_);
      grid_.clear_tile(tile);
      if (is_known) {
        visit(tile, std::as_bytes(std::span(tile_cells_)));
      }
    }
  }

  // One tile back to unknown. For those who measure what that costs.
  void clear_tile(std::size_t tile) { grid_.clear_tile(tile); }

  // All cells back to unknown, no marks.
  void clear();

  // Finds all lines again when they are next asked for, as after the start. For those who measure
  // what it saves to keep them.
  void forget_lines() { lines_.forget(); }

 private:
  // A line of the azimuth at hand, and what of its beams waits to be carved.
  struct OpenLine {
    KeptLine* line = nullptr;
    FreeSteps steps;
  };

  void turn_to(const vehicle::Sensor& sensor, std::uint16_t azimuth_ticks);
  OpenLine& open_line(const vehicle::Layer& layer);
  KeptBeam& beam_of(const vehicle::Layer& layer, std::uint8_t number);
  LinePart part_to_carve(const KeptLine& line, KeptBeam& beam, const lidar::ScanPoint& point,
                         bool is_whole_in_band, traversal::Position hit) const;
  [[nodiscard]] LinePart part_in_band(const KeptLine& line, std::int32_t end_z) const;
  OpenLine& place_to_wait(OpenLine& open, Between end);
  void carve_later(OpenLine& open, const LinePart& part, std::uint32_t range_mm);
  void carve(OpenLine& open);
  void mark(const KeptLine& line, traversal::Position hit, std::uint32_t range_mm);
  void mark_behind(const KeptLine& line, traversal::Position hit, std::uint32_t range_mm);
  void remember(geometry::Cell cell, OccupancyIndex index);

  // What is aligned to a cache line comes first.
  BlockGrid grid_;
  std::array<KeptLine, vehicle::kMaxLayers - KeptAzimuth::kMaxLines> further_lines_;
  BeamLines lines_;
  const vehicle::Vehicle* vehicle_;

  // The azimuth at hand, and its lines by Layer::line; those in use, one bit each.
  const vehicle::Sensor* sensor_ = nullptr;
  KeptAzimuth* kept_ = nullptr;
  vehicle::Direction direction_;
  std::uint32_t lines_in_use_ = 0;
  std::uint16_t azimuth_ticks_ = 0;
  KeptBeam further_beam_;
  std::array<OpenLine, vehicle::kMaxLayers> open_lines_{};

  alignas(8) std::array<OccupancyIndex, geometry::kTileCells> tile_cells_{};

  std::size_t mark_count_ = 0;
  std::array<Mark, kMaxMarks> marks_{};
};

// The most cells that one point of this sensor can mark: its own, and behind it those that its near
// 1D cells reach. A line of length d enters at most sqrt(2) d / cell + 2 further cells.
[[nodiscard]] constexpr std::uint32_t max_marks_per_point(const vehicle::Sensor& sensor) {
  const std::uint32_t near_mm = sensor.profile.near_after_count == 0
                                    ? 0
                                    : (sensor.profile.near_after_count + 1U) * sensor.precision_mm;
  return near_mm == 0 ? 1 : 1 + 2 + near_mm * 3 / (2 * geometry::kCellMm);
}

}  // namespace iog::grid
