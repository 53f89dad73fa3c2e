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
#include "grid/turn_lines.hpp"
#include "grid/waiting_steps.hpp"
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
  // Inline, so that a point is taken apart in registers.
  vehicle::Fate add(const vehicle::Sensor& sensor, const lidar::ScanPoint& point) {
    if (sensor.layers_share_lines) {
      return add_turning(sensor, point);
    }
    if (sensor_ != &sensor || azimuth_ticks_ != point.azimuth_ticks) {
      turn_to(sensor, point.azimuth_ticks);
    }
    KeptBeam& beam =
        kept_->has_beam(point.layer) ? kept_->beam(point.layer) : find_beam(point.layer);
    const vehicle::Classification its =
        vehicle::classify(sensor, beam.ranges(), point, point.range_mm);
    if (its.carves || its.marks) {
      take_kept(beam, its, point.range_mm);
    }
    return its.fate;
  }

  // Carves the beams that still wait.
  void carve_waiting();

  // Forgets the beams that still wait, without carving them.
  void drop_waiting();

  // Finds all lines again when they are next asked for, as after the start.
  void forget_lines() {
    lines_.forget();
    turn_lines_.forget();
  }

 private:
  // Lines of an azimuth that wait at a time. Numbers that follow one another have different places,
  // and so have most that are any power of two apart.
  static constexpr std::uint32_t kOpenLines = 32;
  static constexpr std::uint32_t place_of(std::uint32_t number) {
    return (number ^ number / kOpenLines) % kOpenLines;
  }

  // A line of the azimuth at hand, and what waits to be carved of its beams; none where nothing
  // waits. It has its place by Layer::line.
  struct OpenLine {
    KeptLine* line = nullptr;
    FreeSteps steps;
  };

  // The same of an azimuth step, if layers share lines. So many follow one another at a time:
  // lasers of an HDL-64E look up to 17 degrees to the side of one another, 390 of 8,192 steps.
  static constexpr std::uint32_t kOpenTurnLines = 512;
  struct OpenTurnLine {
    KeptLine* line = nullptr;
    WaitingSteps steps;
  };

  // A line beyond what a KeptAzimuth keeps, by Layer::line.
  struct FurtherLine {
    KeptLine line;
    std::uint32_t number = 0;
  };

  vehicle::Fate add_turning(const vehicle::Sensor& sensor, const lidar::ScanPoint& point);
  void turn_to(const vehicle::Sensor& sensor, std::uint16_t azimuth_ticks);
  [[gnu::noinline]] KeptBeam& find_beam(std::uint8_t layer);
  template <typename Beam>
  void take(Beam&& beam, vehicle::Classification its, std::uint32_t range_mm);
  void take_kept(KeptBeam& beam, vehicle::Classification its, std::uint32_t range_mm);
  FreeSteps& steps_of(const KeptBeam& beam, Between end);
  WaitingSteps& steps_of(const TurnBeam& beam, Between end);
  FreeSteps& steps_on(std::uint32_t number, KeptLine& line);
  KeptLine& further_line(const vehicle::Layer& layer);
  void carve_place(std::uint32_t place);
  // Not inlined, so that it has the registers for itself.
  template <typename Steps>
  [[gnu::noinline]] void carve_later(Steps& steps, const KeptLine& line, const LinePart& part,
                                     std::uint32_t range_mm) const;
  void carve(OpenLine& open) { carve(*open.line, open.steps); }
  void carve(OpenTurnLine& open);
  void carve(KeptLine& line, FreeSteps& steps);

  // Few points need it. It is not inlined, so that the others have the registers.
  [[nodiscard, gnu::noinline]] Between end_without_hit(const KeptLine& line,
                                                       std::uint32_t clears_mm,
                                                       std::uint32_t range_mm) const;

  // What is aligned to a cache line comes first.
  std::array<FurtherLine, kOpenLines> further_lines_;
  BeamLines lines_;
  TurnLines turn_lines_;
  const vehicle::Vehicle* vehicle_;
  BlockGrid* grid_;
  PendingMarks* marks_;

  // The sensor and the azimuth at hand. Its further lines that were found, and the lines of which
  // beams wait, one bit each, by their places. Of a sensor whose layers share lines there is no
  // azimuth at hand.
  const vehicle::Sensor* sensor_ = nullptr;
  KeptAzimuth* kept_ = nullptr;
  std::uint32_t further_found_ = 0;
  std::uint32_t lines_in_use_ = 0;
  std::uint16_t azimuth_ticks_ = 0;
  std::uint32_t azimuth_step_ = 0;
  TurnLine* turn_lines_at_hand_ = nullptr;
  const TurnLayer* turn_layers_at_hand_ = nullptr;
  KeptBeam further_beam_;
  std::array<OpenLine, kOpenLines> open_lines_{};
  std::array<OpenTurnLine, kOpenTurnLines> open_turn_lines_{};
};

}  // namespace iog::grid
