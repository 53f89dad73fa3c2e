// The carver of level units that turn: all layers of an azimuth step share one line
// (turn_lines.hpp), and hundreds of lines wait at a time (waiting_lines.hpp), because their lasers
// do not finish one azimuth before they begin the next.
#pragma once

#include <cstdint>
#include <span>

#include "grid/beam_carver.hpp"
#include "grid/block_grid.hpp"
#include "grid/free_steps.hpp"
#include "grid/pending_marks.hpp"
#include "grid/turn_lines.hpp"
#include "grid/waiting_lines.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

class TurnCarver {
 public:
  // All three outlive the carver.
  TurnCarver(const vehicle::Vehicle& vehicle, BlockGrid& grid, PendingMarks& marks)
      : lines_(vehicle), beams_(vehicle, grid, marks) {}

  // The sensor at hand: what its points ask for, near to one another.
  class Turn {
   public:
    Turn(TurnCarver& carver, const vehicle::Sensor& sensor)
        : carver_(&carver),
          sensor_(&sensor),
          waiting_(&carver.waiting_),
          layers_(carver.layers_->layers.data()),
          azimuths_(sensor.azimuths) {}

    // Carves the beam of this point, now or later, and remembers its mark. The point's layer and
    // azimuth are those of the sensor's format.
    [[gnu::always_inline]] vehicle::Fate add(const lidar::ScanPoint& point) const;

   private:
    TurnCarver* carver_;
    const vehicle::Sensor* sensor_;
    WaitingLines* waiting_;
    const TurnLayer* layers_;
    vehicle::AzimuthSteps azimuths_;
  };

  // The sensor is one of the vehicle's, whose layers share lines. Valid until another one's turn.
  Turn turn_to(const vehicle::Sensor& sensor) {
    if (sensor_ != &sensor) {
      begin_turning(sensor);
    }
    return {*this, sensor};
  }

  // Carves the beams that still wait.
  void carve_waiting();

  // Forgets the beams that still wait, without carving them.
  void drop_waiting() { waiting_.drop(); }

 private:
  void begin_turning(const vehicle::Sensor& sensor);
  // What few points need is not inlined, so that the others have the registers.
  [[gnu::noinline]] void begin_line(std::uint32_t azimuth_step);
  [[gnu::noinline]] void mark_at_start(std::uint32_t azimuth_step);
  void carve_line(std::uint32_t azimuth_step, std::span<const WaitingPoint> points,
                  const RankSet& behind_band);
  // Not inlined, so that the steps' address is in a register and not computed for each change.
  [[gnu::noinline]] std::uint32_t take_points(FreeSteps& steps, const KeptLine& line,
                                              std::span<const WaitingPoint> points);
  [[gnu::noinline]] void take_behind_band(FreeSteps& steps, const KeptLine& line,
                                          const RankSet& ranks, std::uint32_t far_hits) const;
  [[gnu::noinline]] void take_rare(const KeptLine& line, WaitingPoint point);

  // What is aligned to a cache line comes first.
  TurnLines lines_;
  WaitingLines waiting_;
  BeamCarver beams_;
  // The sensor at hand.
  const vehicle::Sensor* sensor_ = nullptr;
  const TurnLayers* layers_ = nullptr;
  FreeSteps steps_;  // of the line that is carved
};

// All layers are on the line of the azimuth, each at its own height.
inline vehicle::Fate TurnCarver::Turn::add(const lidar::ScanPoint& point) const {
  if (point.range_mm == 0 && sensor_->no_return_clears_mm == 0) {
    return vehicle::Fate::kNoReturn;
  }
  const std::uint32_t step = azimuths_.nearest(point.azimuth_ticks);
  if (!waiting_->has_room(step)) [[unlikely]] {
    carver_->begin_line(step);
  }
  const TurnLayer& layer = layers_[point.layer];
  const std::uint32_t along_mm = vehicle::along_line_mm(point.range_mm, layer.range_share);
  const vehicle::BeamRanges ranges{.on_car = waiting_->on_car(step), .in_band = layer.in_band};
  const vehicle::Classification its = vehicle::classify(*sensor_, ranges, point, along_mm);
  if (its.carves || its.marks) {
    if (along_mm == 0 && point.range_mm != 0) [[unlikely]] {
      if (its.marks) {
        carver_->mark_at_start(step);
      }
    } else if (its.is_whole_in_band || along_mm < layer.behind_mm || !its.carves ||
               !waiting_->add_behind_band(step, layer.rank)) {
      waiting_->add(step, {along_mm, point.layer, its});
    }
  }
  return its.fate;
}

}  // namespace iog::grid
