// The ground around each ground-following sensor of a vehicle. The ground stays constant while a
// frame's packets are processed, and it is updated between two frames.
//
// A frame can be shorter than a turn. At the end of a frame, a sensor's surface is updated if the
// ticks swept since the last update add up to at least one complete scan. The timing of the update
// therefore depends only on which packets each frame contains, and not on their order or on the
// cores that fuse them.
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

// The slope of a beam, and the ranges at which it hits the car itself. Both are needed to convert a
// return to a Sample.
struct Ray {
  vehicle::Ranges on_car;
  Slope slope = 0;
};

// The ground around one sensor.
class Ground {
 public:
  Ground() = default;
  // The sensor must be a spinning lidar that follows the ground, and it must outlive this object.
  // The ground is initially flat.
  void begin(const vehicle::Sensor& sensor);

  [[nodiscard]] const Beams& beams() const { return beams_; }
  [[nodiscard]] const Surface& surface() const { return surface_; }
  [[nodiscard]] Limits limits() const { return limits_; }
  // Returns the exit ranges of all beams.
  [[nodiscard]] const Exits& exits() const { return exits_; }
  using Stretch = LowBeams::Stretch;
  // Returns the part of a beam that is low enough to open cells, as two distances along the beam's
  // line. This part extends at most to the beam's exit range.
  [[nodiscard]] Stretch low_stretch(std::uint32_t sector, std::size_t layer) const {
    const std::uint32_t exit_mm = exits_.to_mm(sector, layer);
    if (is_always_low_) {
      return {0, exit_mm};
    }
    const Stretch low = low_beams_.at(sector, layer);
    return {low.from_mm, std::min(exit_mm, low.to_mm)};
  }
  // Returns the distance along the line at which the low part of a beam starts.
  [[nodiscard]] std::uint32_t low_from_mm(std::uint32_t sector, std::size_t layer) const {
    return is_always_low_ ? 0 : low_beams_.at(sector, layer).from_mm;
  }
  // Returns how far above the highest ground nearby a return must be to count as tall. For example,
  // a return within two bins of a bank is compared with the height of the bank, not with the lower
  // ground in front of it. If the result is 0, every return is tall.
  [[nodiscard]] std::int32_t tall_mm() const { return tall_mm_; }

  // Returns the tilt of the car, estimated from one packet of the sensor. `Packet` must have
  // for_each_sample(). `ray_of(step, point)` returns the Ray of a point at an azimuth step.
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
  // Resets the ground to flat.
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
  LowBeams low_beams_;  // not used if all beams are low
};

// A return more than kMostOffPlaneMm above or below the car's plane never counts as tall. Returns
// are projected onto the car's plane to find their cells. If the car tilts by 2 degrees, the
// projection of a return this far from the plane moves by more than one cell, so a static object
// would appear to approach.
inline constexpr std::int32_t kMostOffPlaneMm = 3'000;

// Classifies the returns of one packet.
class PacketJudge {
 public:
  // `ground` and `lows` must outlive this object. `tilt` is the tilt estimated from the packet.
  PacketJudge(const Ground& ground, Lows& lows, Tilt tilt)
      : beams_(&ground.beams()),
        surface_(&ground.surface()),
        lows_(&lows),
        limits_(ground.limits()),
        tall_mm_(ground.tall_mm()),
        tilt_(tilt) {}

  // The result of judge(). `judge()` adds a return to the lows and classifies it by its height
  // above the ground. An obstacle has the outcome kUsed. `z_mm` is the height of the return above
  // the car's plane. The function is not inlined, because a point with a ground estimate needs more
  // registers than the processor has.
  struct Judged {
    vehicle::Fate fate = vehicle::Fate::kUsed;
    bool is_tall = false;
  };
  [[nodiscard, gnu::noinline]] Judged judge(std::uint32_t sector, std::uint32_t out_mm,
                                            std::int32_t z_mm) const {
    const Bins bins = beams_->bins();
    lows_->add(bins, sector, out_mm, z_mm);
    const std::int32_t z_level_mm = z_mm - tilt_.at(out_mm);
    const std::int32_t over = surface_->height_over(bins, sector, out_mm, z_level_mm);
    // The ground directly below a return is never higher than the highest ground nearby. Most
    // returns can therefore be rejected by their height above the ground directly below them.
    const bool is_tall = over >= tall_mm_ &&
                         (tall_mm_ == 0 || (z_mm >= -kMostOffPlaneMm && z_mm <= kMostOffPlaneMm &&
                                            surface_->height_over_near(bins, sector, out_mm,
                                                                       z_level_mm) >= tall_mm_));
    return {.fate = fate_of(ground::judge(limits_, over)), .is_tall = is_tall};
  }

 private:
  [[nodiscard]] static constexpr vehicle::Fate fate_of(Kind kind) {
    using vehicle::Fate;
    switch (kind) {
      case Kind::kGround:
        return Fate::kGround;
      case Kind::kObstacle:
        return Fate::kUsed;
      case Kind::kOverhang:
        return Fate::kOverhang;
      default:
        return Fate::kUnderGround;
    }
  }

  const Beams* beams_;
  const Surface* surface_;
  Lows* lows_;
  Limits limits_;
  std::int32_t tall_mm_;
  Tilt tilt_;
};

// The ground around each ground-following sensor. Each of these sensors has an index, called
// `place` in the code. The object must be static because it takes up 630 KB.
class Grounds {
 public:
  // The vehicle must outlive this object.
  explicit Grounds(const vehicle::Vehicle& vehicle);

  // Returns the index of a sensor among the ground-following sensors, or std::nullopt if the sensor
  // does not follow the ground.
  [[nodiscard]] std::optional<std::size_t> place_of(std::size_t sensor) const {
    const std::uint8_t place = places_[sensor];
    return place == kNone ? std::nullopt : std::optional<std::size_t>(place);
  }
  [[nodiscard]] const Ground& at(std::size_t place) const { return grounds_[place]; }

  // Specifies what happens to a sensor's lows at the end of a frame.
  enum class LowsAre : std::uint8_t {
    kKept,       // the turn is not complete yet: keep them
    kOfTurn,     // the turn is complete: pass them to close_turn(), then clear them
    kForgotten,  // the sensor sends nothing and its ground was reset to flat: clear them
  };

  // Ends a frame in which the sensor has swept `swept_ticks` ticks. The sensor must follow the
  // ground.
  [[nodiscard]] LowsAre end_frame(std::size_t sensor, std::uint32_t swept_ticks);
  // `lows` contains the lowest returns of the turn, merged over all cores.
  void close_turn(std::size_t sensor, const Lows& lows) {
    grounds_[places_[sensor]].close_turn(walk_, lows);
  }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, vehicle_, places_);
  }

 private:
  // If a sensor has been silent for kForgottenUs, the car may have moved to a different place. This
  // time is measured in whole frame periods.
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
