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
#include <span>

#include "grid/beam_lines.hpp"
#include "grid/block_grid.hpp"
#include "grid/free_steps.hpp"
#include "grid/pending_marks.hpp"
#include "grid/turn_lines.hpp"
#include "grid/waiting_lines.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

class Carver {
 public:
  // All three outlive the carver.
  Carver(const vehicle::Vehicle& vehicle, BlockGrid& grid, PendingMarks& marks);

  // Carves the beam of this point, now or later, and remembers its mark. The sensor is one of the
  // vehicle's; the point's layer and azimuth are those of its format.
  vehicle::Fate add(const vehicle::Sensor& sensor, const lidar::ScanPoint& point) {
    return sensor.layers_share_lines ? turn_to(sensor).add(point) : add_kept(sensor, point);
  }

  // The same for all points of a packet: for_each_point(visit) calls visit(point) for each of them.
  // count(fate) is called for each. Inline, so that a point is taken apart in registers.
  template <typename Packet, typename Count>
  void add_all(const vehicle::Sensor& sensor, const Packet& packet, Count&& count) {
    if (sensor.layers_share_lines) {
      packet.for_each_point([count, turn = turn_to(sensor)](const lidar::ScanPoint& point) {
        count(turn.add(point));
      });
    } else {
      packet.for_each_point([&](const lidar::ScanPoint& point) { count(add_kept(sensor, point)); });
    }
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

  // A line beyond what a KeptAzimuth keeps, by Layer::line.
  struct FurtherLine {
    KeptLine line;
    std::uint32_t number = 0;
  };

  // The sensor at hand, if its layers share lines: what its points ask for, near to one another.
  class Turn {
   public:
    Turn(Carver& carver, const vehicle::Sensor& sensor)
        : carver_(&carver),
          sensor_(&sensor),
          lines_(&carver.waiting_lines_),
          layers_(carver.turn_layers_at_hand_->layers.data()),
          azimuths_(sensor.azimuths) {}
    [[gnu::always_inline]] vehicle::Fate add(const lidar::ScanPoint& point) const;

   private:
    Carver* carver_;
    const vehicle::Sensor* sensor_;
    WaitingLines* lines_;
    const TurnLayer* layers_;
    vehicle::AzimuthSteps azimuths_;
  };

  [[gnu::always_inline]] vehicle::Fate add_kept(const vehicle::Sensor& sensor,
                                                const lidar::ScanPoint& point);
  void turn_to(const vehicle::Sensor& sensor, std::uint16_t azimuth_ticks);
  Turn turn_to(const vehicle::Sensor& sensor) {
    if (sensor_ != &sensor) {
      begin_turning(sensor);
    }
    return {*this, sensor};
  }
  void begin_turning(const vehicle::Sensor& sensor);
  // What few points need is not inlined, so that the others have the registers.
  [[gnu::noinline]] void begin_line(std::uint32_t azimuth_step);
  [[gnu::noinline]] void mark_at_start(std::uint32_t azimuth_step);
  [[gnu::noinline]] KeptBeam& find_beam(std::uint8_t layer);
  template <typename Beam>
  void take(Beam&& beam, vehicle::Classification its, std::uint32_t range_mm);
  void take_kept(KeptBeam& beam, vehicle::Classification its, std::uint32_t range_mm);
  FreeSteps& steps_of(const KeptBeam& beam, Between end);
  FreeSteps& steps_of(const TurnBeam& /*beam*/, Between /*end*/) { return open_lines_[0].steps; }
  FreeSteps& steps_on(std::uint32_t number, KeptLine& line);
  KeptLine& further_line(const vehicle::Layer& layer);
  void carve_place(std::uint32_t place);
  // Inline, because a call costs as much as a zone.
  [[gnu::always_inline]] void carve_later(FreeSteps& steps, const KeptLine& line,
                                          const LinePart& part, std::uint32_t range_mm) const;
  [[gnu::always_inline]] void add_zones(FreeSteps& steps, const KeptLine& line,
                                        const LinePart& part, std::uint32_t range_mm) const;
  void carve(OpenLine& open) { carve(*open.line, open.steps); }
  void carve_turn(std::uint32_t azimuth_step, std::span<const WaitingPoint> points,
                  const RankSet& behind_band);
  // Not inlined, so that the steps' address is in a register and not computed for each change.
  [[gnu::noinline]] std::uint32_t take_points(FreeSteps& steps, const KeptLine& line,
                                              std::span<const WaitingPoint> points);
  [[gnu::noinline]] void take_behind_band(FreeSteps& steps, const KeptLine& line,
                                          const RankSet& ranks, std::uint32_t far_hits) const;
  [[gnu::noinline]] void take_rare(const KeptLine& line, WaitingPoint point);
  void carve(KeptLine& line, FreeSteps& steps);

  [[nodiscard, gnu::noinline]] Between end_without_hit(const KeptLine& line,
                                                       std::uint32_t clears_mm,
                                                       std::uint32_t range_mm) const;

  // What is aligned to a cache line comes first.
  TurnLines turn_lines_;
  WaitingLines waiting_lines_;
  std::array<FurtherLine, kOpenLines> further_lines_;
  BeamLines lines_;
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
  const TurnLayers* turn_layers_at_hand_ = nullptr;
  KeptBeam further_beam_;
  std::array<OpenLine, kOpenLines> open_lines_{};
};

inline vehicle::Fate Carver::add_kept(const vehicle::Sensor& sensor,
                                      const lidar::ScanPoint& point) {
  if (sensor_ != &sensor || azimuth_ticks_ != point.azimuth_ticks) {
    turn_to(sensor, point.azimuth_ticks);
  }
  KeptBeam& beam = kept_->has_beam(point.layer) ? kept_->beam(point.layer) : find_beam(point.layer);
  const vehicle::Classification its =
      vehicle::classify(sensor, beam.ranges(), point, point.range_mm);
  if (its.carves || its.marks) {
    take_kept(beam, its, point.range_mm);
  }
  return its.fate;
}

// All layers are on the line of the azimuth, each at its own height.
inline vehicle::Fate Carver::Turn::add(const lidar::ScanPoint& point) const {
  if (point.range_mm == 0 && sensor_->no_return_clears_mm == 0) {
    return vehicle::Fate::kNoReturn;
  }
  const std::uint32_t step = azimuths_.nearest(point.azimuth_ticks);
  if (!lines_->has_room(step)) [[unlikely]] {
    carver_->begin_line(step);
  }
  const TurnLayer& layer = layers_[point.layer];
  const std::uint32_t along_mm = vehicle::along_line_mm(point.range_mm, layer.range_share);
  const vehicle::BeamRanges ranges{.on_car = lines_->on_car(step), .in_band = layer.in_band};
  const vehicle::Classification its = vehicle::classify(*sensor_, ranges, point, along_mm);
  if (its.carves || its.marks) {
    if (along_mm == 0 && point.range_mm != 0) [[unlikely]] {
      if (its.marks) {
        carver_->mark_at_start(step);
      }
    } else if (its.is_whole_in_band || along_mm < layer.behind_mm || !its.carves ||
               !lines_->add_behind_band(step, layer.rank)) {
      lines_->add(step, {along_mm, point.layer, its.fate});
    }
  }
  return its.fate;
}

}  // namespace iog::grid
