// What is known of the ground around the sensors of a vehicle. It is frozen while the packets of a
// frame are judged, and renewed between two frames.
//
// A frame may be shorter than a turn. So a sensor's surface is renewed at the end of the frame in
// which it has swept as many ticks as its whole scan has, since it was renewed before: which
// packets are in a frame decides, and neither their order nor who fuses them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "ground/beams.hpp"
#include "ground/exits.hpp"
#include "ground/judge.hpp"
#include "ground/low_beams.hpp"
#include "ground/lows.hpp"
#include "ground/surface.hpp"
#include "ground/surface_walk.hpp"
#include "ground/tilt.hpp"
#include "health/constants.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::ground {

// What a sample wants to know of its beam: the ranges that end on the car itself, and how it rises.
struct Ray {
  vehicle::Ranges on_car;
  Slope slope = 0;
};

// Around one sensor.
class Ground {
 public:
  Ground() = default;
  // The sensor turns and follows the ground, and outlives it. At first the ground is flat.
  void begin(const vehicle::Sensor& sensor);

  [[nodiscard]] const Beams& beams() const { return beams_; }
  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] Limits limits() const { return limits_; }
  // How far beams are between the limits, of a sensor whose layers share lines.
  [[nodiscard]] const Exits& exits() const { return exits_; }
  using Stretch = LowBeams::Stretch;
  // Between which distances along its line a beam is so low that it opens ground: all the way, if
  // one of any height does. Up to its exit, of a sensor whose layers share lines.
  [[nodiscard]] Stretch low_stretch(std::uint32_t sector, std::size_t layer) const {
    const std::uint32_t exit_mm =
        sensor_->layers_share_lines ? exits_.to_mm(sector, layer) : beams_.range_mm();
    if (is_always_low_) {
      return {0, exit_mm};
    }
    const Stretch low = low_beams_.at(sector, layer);
    return {low.from_mm, std::min(exit_mm, low.to_mm)};
  }
  // So near a beam is never low.
  [[nodiscard]] std::uint32_t low_from_mm(std::uint32_t sector, std::size_t layer) const {
    return is_always_low_ ? 0 : low_beams_.at(sector, layer).from_mm;
  }
  // How high over the highest ground nearby a return is at least that is tall: a bank that begins
  // within a bin or two is not tall over the ground before it. 0: each is.
  [[nodiscard]] std::int32_t tall_mm() const { return tall_mm_; }

  // How a packet of the sensor sees the car tilted. Packet: has for_each_sample(). ray_of(step,
  // point) is the Ray of a point in this azimuth step.
  template <typename Packet, typename RayOf>
  [[nodiscard]] Tilt tilt_of(const vehicle::Sensor& sensor, const Packet& packet,
                             RayOf&& ray_of) const {
    Samples samples;
    packet.for_each_sample(beams_.sampling(), [&](const lidar::ScanPoint& point) {
      if (point.range_mm < std::max(sensor.range_min_mm, kFirstSampleMm)) {
        return;
      }
      const std::uint32_t step = sensor.azimuths.nearest(point.azimuth_ticks);
      const Ray ray = ray_of(step, point);
      if (!ray.on_car.contain(point.range_mm)) {
        const std::uint32_t out_mm = beams_.out_mm(point.layer, point.range_mm);
        const std::int32_t z_mm =
            beams_.height_mm(ray.slope, sensor.layers[point.layer].along_line_mm(point.range_mm));
        samples.add(out_mm,
                    surface_.height_over(beams_.bins(), beams_.sector_of(step), out_mm, z_mm));
      }
    });
    return ground::tilt_of(samples.all(), beams_.fewest_samples());
  }

  void close_turn(SurfaceWalk& walk, const Lows& lows);
  // Flat again.
  void forget();

 private:
  void find_exits();

  const vehicle::Sensor* sensor_ = nullptr;
  Beams beams_;
  Limits limits_;
  bool is_always_low_ = true;
  std::int32_t low_mm_ = 0;
  std::int32_t tall_mm_ = 0;
  Surface surface_;
  Exits exits_;
  LowBeams low_beams_;  // of nothing if they are always low
};

// What is farther over or under the car's plane is not tall. Its cell is where it lies on that
// plane, and moves by more than a cell when the car tilts by 2 degrees: what stands would come
// nearer.
inline constexpr std::int32_t kMostOffPlaneMm = 3'000;

// The returns of one packet.
class PacketJudge {
 public:
  // Both outlive it. The tilt is that of the packet.
  PacketJudge(const Ground& ground, Lows& lows, Tilt tilt)
      : beams_(&ground.beams()),
        surface_(&ground.surface()),
        lows_(&lows),
        limits_(ground.limits()),
        tall_mm_(ground.tall_mm()),
        tilt_(tilt) {}

  // Which fate a return has by its height over the ground, kUsed if it is an obstacle, and whether
  // it is tall. It is among the lows then. z_mm: its height over the car's plane.
  struct Judged {
    vehicle::Fate fate = vehicle::Fate::kUsed;
    bool is_tall = false;
  };
  [[nodiscard]] Judged judge(std::uint32_t sector, std::uint32_t out_mm, std::int32_t z_mm) const {
    const Bins bins = beams_->bins();
    lows_->add(bins, sector, out_mm, z_mm);
    const std::int32_t z_level_mm = z_mm - tilt_.at(out_mm);
    const std::int32_t over = surface_->height_over(bins, sector, out_mm, z_level_mm);
    // Most returns are not even so high over their own ground, which is never higher.
    const bool is_tall = over >= tall_mm_ &&
                         (tall_mm_ == 0 || (z_mm >= -kMostOffPlaneMm && z_mm <= kMostOffPlaneMm &&
                                            surface_->height_over_near(bins, sector, out_mm,
                                                                       z_level_mm) >= tall_mm_));
    return {.fate = fate_of(ground::judge(limits_, over)), .is_tall = is_tall};
  }

 private:
  [[nodiscard]] static constexpr vehicle::Fate fate_of(Kind kind) {
    using vehicle::Fate;
    constexpr std::array kFates{Fate::kGround, Fate::kUsed, Fate::kOverhang, Fate::kUnderGround};
    return kFates[static_cast<std::size_t>(kind)];
  }

  const Beams* beams_;
  const Surface* surface_;
  Lows* lows_;
  Limits limits_;
  std::int32_t tall_mm_;
  Tilt tilt_;
};

// Around those of a vehicle that follow the ground, each in a place. Holds 630 KB: belongs into
// static memory.
class Grounds {
 public:
  // vehicle outlives it.
  explicit Grounds(const vehicle::Vehicle& vehicle);

  // Of the vehicle's sensor of this number; none if it does not follow the ground.
  [[nodiscard]] std::optional<std::size_t> place_of(std::size_t sensor) const {
    const std::uint8_t place = places_[sensor];
    return place == kNone ? std::nullopt : std::optional<std::size_t>(place);
  }
  [[nodiscard]] const Ground& at(std::size_t place) const { return grounds_[place]; }

  // What becomes of a sensor's lows when a frame is over.
  enum class LowsAre : std::uint8_t {
    kKept,       // more of the turn is to come
    kOfTurn,     // a turn is over: close_turn() wants them, and then they are cleared
    kForgotten,  // the sensor is silent, and the ground is flat again: they are cleared
  };

  // A frame is over in which the sensor, which follows the ground, has swept so many ticks.
  [[nodiscard]] LowsAre end_frame(std::size_t sensor, std::uint32_t swept_ticks);
  // The lowest returns of the turn, of all cores.
  void close_turn(std::size_t sensor, const Lows& lows) {
    grounds_[places_[sensor]].close_turn(walk_, lows);
  }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, vehicle_, places_);
  }

 private:
  // A sensor that is silent for so long, in frame periods, may be elsewhere when it is back.
  static constexpr std::uint64_t kForgottenUs = 1'000'000;

  struct Turn {
    std::uint32_t swept_ticks = 0;
    std::uint64_t silent_us = 0;
  };

  static constexpr std::uint8_t kNone = 0xFF;

  const vehicle::Vehicle* vehicle_;
  std::array<std::uint8_t, vehicle::kMaxSensors> places_{};
  std::array<Turn, vehicle::kMaxGroundSensors> turns_{};
  std::array<Ground, vehicle::kMaxGroundSensors> grounds_;
  SurfaceWalk walk_;
};

}  // namespace iog::ground
