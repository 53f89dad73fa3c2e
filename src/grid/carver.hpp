// What carves: beams in, free cells out.
//
// Saturated sums of negative indexes commute (docs/model.md section 3), so the order in which beams
// carve does not show. Therefore beams of one azimuth wait for one another: those of one line, or
// of lines through the same cells, are carved together. For the same reason the beams of a frame
// may be divided among carvers, each with a grid of its own. The saturated sum of their grids is
// the grid of one carver.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "grid/beam_lines.hpp"
#include "grid/block_grid.hpp"
#include "grid/free_steps.hpp"
#include "grid/pending_marks.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

class Carver {
 public:
  // All three outlive the carver.
  Carver(const vehicle::Vehicle& vehicle, BlockGrid& grid, PendingMarks& marks);

  // Carves the beam of this point, now or later, and remembers its mark. The sensor is one of the
  // vehicle's; the point's layer and azimuth are those of its format. Only if the marks have room.
  vehicle::Fate add(const vehicle::Sensor& sensor, const lidar::ScanPoint& point);

  // Carves the beams that still wait.
  void carve_waiting();

  // Forgets the beams that still wait, without carving them.
  void drop_waiting();

  // Finds all lines again when they are next asked for, as after the start.
  void forget_lines() { lines_.forget(); }

 private:
  // A line of the azimuth at hand, and what waits to be carved of its beams.
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

  // What is aligned to a cache line comes first.
  std::array<KeptLine, vehicle::kMaxLayers - KeptAzimuth::kMaxLines> further_lines_;
  BeamLines lines_;
  const vehicle::Vehicle* vehicle_;
  BlockGrid* grid_;
  PendingMarks* marks_;

  // The azimuth at hand, and its lines by Layer::line; those in use, one bit each.
  const vehicle::Sensor* sensor_ = nullptr;
  KeptAzimuth* kept_ = nullptr;
  vehicle::Direction direction_;
  std::uint32_t lines_in_use_ = 0;
  std::uint16_t azimuth_ticks_ = 0;
  KeptBeam further_beam_;
  std::array<OpenLine, vehicle::kMaxLayers> open_lines_{};
};

}  // namespace iog::grid
