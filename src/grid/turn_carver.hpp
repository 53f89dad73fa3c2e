// Carves the beams of level rotating lidars. All layers of an azimuth step share one line
// (turn_lines.hpp). Hundreds of lines are pending at the same time, because different lasers
// measure at different azimuths (waiting_lines.hpp).
#pragma once

#include <cstdint>
#include <span>

#include "grid/beam_carver.hpp"
#include "grid/frame_grids.hpp"
#include "grid/free_steps.hpp"
#include "grid/gates.hpp"
#include "grid/pending_marks.hpp"
#include "grid/turn_lines.hpp"
#include "grid/waiting_lines.hpp"
#include "ground/ground.hpp"
#include "ground/tilt.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

class TurnCarver {
 public:
  // All arguments must outlive the carver.
  TurnCarver(const vehicle::Vehicle& vehicle, FrameGrids& grids, PendingMarks& marks)
      : lines_(vehicle), beams_(grids, marks) {}

  // The current sensor. The data that every point needs is stored close together in memory.
  template <typename Judge>
  class Turn {
   public:
    Turn(TurnCarver& carver, const vehicle::Sensor& sensor, const Judge& judge)
        : carver_(&carver),
          sensor_(&sensor),
          waiting_(&carver.waiting_),
          layers_(carver.layers_),
          azimuths_(sensor.azimuths),
          judge_(judge) {}

    // Adds this point and returns its outcome. The point's beam is carved together with the other
    // beams of its line. The point's layer and azimuth must be valid in the sensor's format.
    [[gnu::always_inline]] vehicle::Fate add(const lidar::ScanPoint& point) const;

   private:
    TurnCarver* carver_;
    const vehicle::Sensor* sensor_;
    WaitingLines* waiting_;
    const TurnLayers* layers_;
    vehicle::AzimuthSteps azimuths_;
    Judge judge_;
  };

  // The sensor must belong to the vehicle, and its layers must share lines. The result is valid
  // until turn_to() is called for another sensor.
  Turn<BandJudge> turn_to(const vehicle::Sensor& sensor) {
    begin_turning(sensor, nullptr);
    return {*this, sensor, {}};
  }
  // Same as above, for a packet of a sensor with a ground estimate (docs/ground.md). The ground
  // must not change while beams are pending.
  Turn<GroundJudge> turn_to(const vehicle::Sensor& sensor, const ground::Ground& ground,
                            const ground::PacketJudge& judge) {
    begin_turning(sensor, &ground);
    return {*this, sensor, {&ground.beams(), &ground.exits(), judge}};
  }

  // Estimates the car's tilt from one packet. The packet type must have for_each_sample().
  template <typename Packet>
  [[nodiscard]] ground::Tilt tilt_of(const vehicle::Sensor& sensor, const ground::Ground& ground,
                                     const Packet& packet);

  // Carves all pending beams.
  void carve_waiting();

  // Drops all pending beams without carving them.
  void drop_waiting() { waiting_.drop(); }

 private:
  void begin_turning(const vehicle::Sensor& sensor, const ground::Ground* ground) {
    if (sensor_ != &sensor || ground_ != ground) {
      turn_from_another(sensor, ground);
    }
  }
  void turn_from_another(const vehicle::Sensor& sensor, const ground::Ground* ground);
  // Rare paths are not inlined, so that the common path can keep its values in registers.
  [[gnu::noinline]] void begin_line(std::uint32_t azimuth_step);
  [[gnu::noinline]] void mark_at_start(std::uint32_t azimuth_step, bool is_tall);
  void carve_line(std::uint32_t azimuth_step, std::span<const WaitingPoint> points,
                  const RankSet& behind);
  // Gate is either BandGate or GroundGate, depending on the line. Functions with a `steps`
  // parameter are not inlined, so that the address of `steps` stays in a register instead of being
  // recomputed for each change.
  template <typename Gate>
  void add_beams(const Gate& gate, const KeptLine& line, std::span<const WaitingPoint> points,
                 const RankSet& behind);
  template <bool kWithHeights, typename Gate>
  [[gnu::noinline]] std::uint32_t add_points(FreeSteps& steps, const Gate& gate,
                                             const KeptLine& line,
                                             std::span<const WaitingPoint> points);
  template <typename Gate>
  [[gnu::noinline]] void add_behind(FreeSteps& steps, const Gate& gate, const KeptLine& line,
                                    const RankSet& ranks, std::uint32_t far_hits) const;
  template <typename Gate>
  [[gnu::noinline]] static void add_low(LineSteps& steps, const Gate& gate, const LinePart& freed,
                                        std::size_t layer);
  template <typename Gate>
  [[gnu::noinline]] void add_low_behind(const Gate& gate, const RankSet& ranks);
  template <typename Gate>
  [[gnu::noinline]] void add_rare(const Gate& gate, const KeptLine& line, WaitingPoint point);

  // Members aligned to a cache line come first.
  TurnLines lines_;
  WaitingLines waiting_;
  BeamCarver beams_;
  // The current sensor.
  const vehicle::Sensor* sensor_ = nullptr;
  const TurnLayers* layers_ = nullptr;
  const ground::Ground* ground_ = nullptr;  // if the sensor has an estimated ground
  LineSteps steps_;                         // of the line being carved
};

// All layers at an azimuth share one line, but each layer has its own height.
template <typename Judge>
inline vehicle::Fate TurnCarver::Turn<Judge>::add(const lidar::ScanPoint& point) const {
  if (point.range_mm == 0 && sensor_->no_return_clears_mm == 0) {
    return vehicle::Fate::kNoReturn;
  }
  const std::uint32_t step = azimuths_.nearest(point.azimuth_ticks);
  if (!waiting_->has_room(step)) [[unlikely]] {
    carver_->begin_line(step);
  }
  const std::uint32_t along_mm =
      vehicle::along_line_mm(point.range_mm, layers_->layers[point.layer].range_share);
  bool is_tall = false;
  const vehicle::Classification classified =
      vehicle::classify(*sensor_, waiting_->on_car(step), point, along_mm,
                        judge_.height_at(*layers_, step, point.layer, along_mm, is_tall));
  const vehicle::Evidence evidence = classified.evidence;
  if (evidence.is_any()) {
    if (along_mm == 0 && point.range_mm != 0) [[unlikely]] {
      if (evidence.marks()) {
        carver_->mark_at_start(step, is_tall);
      }
    } else if (evidence.marks() || evidence.is_whole_in_band() ||
               along_mm < judge_.behind_mm(*layers_, step, point.layer) ||
               !waiting_->add_behind(step, judge_.rank(*layers_, step, point.layer))) {
      waiting_->add(step, {{along_mm, evidence, is_tall}, point.layer});
    }
  }
  return classified.fate;
}

template <typename Packet>
inline ground::Tilt TurnCarver::tilt_of(const vehicle::Sensor& sensor, const ground::Ground& ground,
                                        const Packet& packet) {
  return ground.tilt_of(sensor, packet, [&](std::uint32_t step, const lidar::ScanPoint& point) {
    return ground::Ray{.on_car = lines_.on_car(sensor, step),
                       .slope = ground.beams().slope(point.layer)};
  });
}

}  // namespace iog::grid
