// The carver of level units that turn: all layers of an azimuth step share one line
// (turn_lines.hpp), and hundreds of lines wait at a time (waiting_lines.hpp), because their lasers
// do not finish one azimuth before they begin the next.
#pragma once

#include <cstdint>
#include <span>

#include "grid/beam_carver.hpp"
#include "grid/frame_grids.hpp"
#include "grid/free_steps.hpp"
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
  // All three outlive the carver.
  TurnCarver(const vehicle::Vehicle& vehicle, FrameGrids& grids, PendingMarks& marks)
      : lines_(vehicle), beams_(vehicle, grids, marks) {}

  // The sensor at hand: what its points ask for, near to one another.
  class Turn {
   protected:
    Turn(TurnCarver& carver, const vehicle::Sensor& sensor)
        : carver_(&carver),
          sensor_(&sensor),
          waiting_(&carver.waiting_),
          layers_(carver.layers_->layers.data()),
          azimuths_(sensor.azimuths) {}

    // Whether nothing can be said of the point's beam.
    [[nodiscard]] bool is_nothing(const lidar::ScanPoint& point) const {
      return point.range_mm == 0 && sensor_->no_return_clears_mm == 0;
    }
    // The azimuth step of the point, whose line has room then.
    [[nodiscard, gnu::always_inline]] std::uint32_t step_of(const lidar::ScanPoint& point) const;

    TurnCarver* carver_;
    const vehicle::Sensor* sensor_;
    WaitingLines* waiting_;
    const TurnLayer* layers_;
    vehicle::AzimuthSteps azimuths_;
  };

  // By the height band of the vehicle.
  class TurnInBand : public Turn {
   public:
    TurnInBand(TurnCarver& carver, const vehicle::Sensor& sensor)
        : Turn(carver, sensor), tall_(carver.layers_->tall.data()) {}

    // Carves the beam of this point, now or later, and remembers its mark. The point's layer and
    // azimuth are those of the sensor's format.
    [[gnu::always_inline]] vehicle::Fate add(const lidar::ScanPoint& point) const;

   private:
    const vehicle::Ranges* tall_;
  };

  // The same of a packet of a sensor that follows the ground (docs/ground.md).
  class TurnOverGround : public Turn {
   public:
    TurnOverGround(TurnCarver& carver, const vehicle::Sensor& sensor, const ground::Ground& ground,
                   const ground::PacketJudge& judge)
        : Turn(carver, sensor),
          beams_(&ground.beams()),
          exits_(&ground.exits()),
          behind_mm_(carver.behind_mm_),
          judge_(judge) {}

    [[gnu::always_inline]] vehicle::Fate add(const lidar::ScanPoint& point) const;

   private:
    const ground::Beams* beams_;
    const ground::Exits* exits_;
    std::uint32_t behind_mm_;
    ground::PacketJudge judge_;
  };

  // The sensor is one of the vehicle's, whose layers share lines. Valid until another one's turn.
  TurnInBand turn_to(const vehicle::Sensor& sensor) {
    begin_turning(sensor, nullptr);
    return {*this, sensor};
  }
  // The ground stays as it is while beams wait.
  TurnOverGround turn_to(const vehicle::Sensor& sensor, const ground::Ground& ground,
                         const ground::PacketJudge& judge) {
    begin_turning(sensor, &ground);
    return {*this, sensor, ground, judge};
  }

  // How a packet sees the car tilted. Packet: has for_each_sample().
  template <typename Packet>
  [[nodiscard]] ground::Tilt tilt_of(const vehicle::Sensor& sensor, const ground::Ground& ground,
                                     const Packet& packet);

  // Carves the beams that still wait.
  void carve_waiting();

  // Forgets the beams that still wait, without carving them.
  void drop_waiting() { waiting_.drop(); }

 private:
  void begin_turning(const vehicle::Sensor& sensor, const ground::Ground* ground) {
    if (sensor_ != &sensor || ground_ != ground) {
      turn_from_another(sensor, ground);
    }
  }
  void turn_from_another(const vehicle::Sensor& sensor, const ground::Ground* ground);
  // What few points need is not inlined, so that the others have the registers.
  [[gnu::noinline]] void begin_line(std::uint32_t azimuth_step);
  [[gnu::noinline]] void mark_at_start(std::uint32_t azimuth_step, bool is_tall);
  void carve_line(std::uint32_t azimuth_step, std::span<const WaitingPoint> points,
                  const RankSet& behind_band);
  // far_mm: as in TurnLayers. sector: of the ground, if it is followed. end_of(rank): where the
  // layer of this rank leaves what counts of its line.
  std::uint32_t add_points(const KeptLine& line, std::span<const WaitingPoint> points,
                           std::uint32_t far_mm, std::uint32_t sector) {
    return beams_.keeps_heights() ? add_points<true>(steps_.free, line, points, far_mm, sector)
                                  : add_points<false>(steps_.free, line, points, far_mm, sector);
  }
  // Not inlined, so that the steps' address is in a register and not computed for each change.
  template <bool kWithHeights>
  [[gnu::noinline]] std::uint32_t add_points(FreeSteps& steps, const KeptLine& line,
                                             std::span<const WaitingPoint> points,
                                             std::uint32_t far_mm, std::uint32_t sector);
  template <typename EndOf>
  [[gnu::noinline]] void add_behind_band(FreeSteps& steps, const KeptLine& line,
                                         const RankSet& ranks, std::uint32_t far_hits,
                                         EndOf end_of) const;
  [[gnu::noinline]] void add_rare(const KeptLine& line, WaitingPoint point, std::uint32_t sector);
  // Where beams are low: that of a hit which frees so much of its line, and those that are behind
  // the band. Over the ground most hits are nearer than their beams are low.
  [[nodiscard]] bool may_be_low(WaitingPoint hit, std::uint32_t sector) const {
    return ground_ == nullptr || ground_->low_from_mm(sector, hit.layer()) < hit.along_mm();
  }
  [[gnu::noinline]] void add_low(const KeptLine& line, const LinePart& freed, WaitingPoint hit,
                                 std::uint32_t sector);
  [[gnu::noinline]] void add_low_behind_band(const KeptLine& line, const RankSet& ranks,
                                             std::uint32_t sector);
  void add_low_over_ground(const KeptLine& line, const RankSet& ranks, std::uint32_t sector);
  void add_low_stretch(LineSteps& steps, const KeptLine& line,
                       ground::Ground::Stretch stretch) const;

  // What is aligned to a cache line comes first.
  TurnLines lines_;
  WaitingLines waiting_;
  BeamCarver beams_;
  // The sensor at hand.
  const vehicle::Sensor* sensor_ = nullptr;
  const TurnLayers* layers_ = nullptr;
  const ground::Ground* ground_ = nullptr;  // if it is followed
  std::uint32_t behind_mm_ = 0;             // BandLimits::behind_mm()
  LineSteps steps_;                         // of the line that is carved
};

inline std::uint32_t TurnCarver::Turn::step_of(const lidar::ScanPoint& point) const {
  const std::uint32_t step = azimuths_.nearest(point.azimuth_ticks);
  if (!waiting_->has_room(step)) [[unlikely]] {
    carver_->begin_line(step);
  }
  return step;
}

// All layers are on the line of the azimuth, each at its own height.
inline vehicle::Fate TurnCarver::TurnInBand::add(const lidar::ScanPoint& point) const {
  if (is_nothing(point)) {
    return vehicle::Fate::kNoReturn;
  }
  const std::uint32_t step = step_of(point);
  const TurnLayer& layer = layers_[point.layer];
  const std::uint32_t along_mm = vehicle::along_line_mm(point.range_mm, layer.range_share);
  const vehicle::BeamRanges ranges{.on_car = waiting_->on_car(step), .in_band = layer.in_band};
  const vehicle::Classification classified = vehicle::classify(*sensor_, ranges, point, along_mm);
  const vehicle::Evidence evidence = classified.evidence;
  if (evidence.is_any()) {
    const bool is_tall = evidence.marks() && tall_[point.layer].contain(along_mm);
    if (along_mm == 0 && point.range_mm != 0) [[unlikely]] {
      if (evidence.marks()) {
        carver_->mark_at_start(step, is_tall);
      }
    } else if (evidence.is_whole_in_band() || along_mm < layer.behind_mm || !evidence.carves() ||
               !waiting_->add_behind_band(step, layer.rank)) {
      waiting_->add(step, {{along_mm, evidence, is_tall}, point.layer});
    }
  }
  return classified.fate;
}

// Where a beam leaves the limits is its layer's and its sector's own.
inline vehicle::Fate TurnCarver::TurnOverGround::add(const lidar::ScanPoint& point) const {
  if (is_nothing(point)) {
    return vehicle::Fate::kNoReturn;
  }
  const std::uint32_t step = step_of(point);
  const std::uint32_t along_mm =
      vehicle::along_line_mm(point.range_mm, layers_[point.layer].range_share);
  const std::uint32_t sector = beams_->sector_of(step);
  const std::uint32_t to_mm = exits_->to_mm(sector, point.layer);
  bool is_tall = false;
  const vehicle::Classification classified = vehicle::classify(
      *sensor_, waiting_->on_car(step), point, along_mm, [&](std::uint32_t reach_mm) {
        const std::int32_t z_mm = beams_->height_mm(beams_->slope(point.layer), along_mm);
        const auto judged = judge_.judge(sector, along_mm, z_mm);
        is_tall = judged.is_tall;
        return vehicle::Height{.is_obstacle = judged.fate == vehicle::Fate::kUsed,
                               .otherwise = judged.fate,
                               .is_whole = reach_mm <= to_mm};
      });
  const vehicle::Evidence evidence = classified.evidence;
  if (evidence.is_any()) {
    if (along_mm == 0 && point.range_mm != 0) [[unlikely]] {
      if (evidence.marks()) {
        carver_->mark_at_start(step, is_tall);
      }
    } else if (evidence.marks() || evidence.is_whole_in_band() || along_mm < to_mm + behind_mm_ ||
               !waiting_->add_behind_band(step, exits_->rank_of(sector, point.layer))) {
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
