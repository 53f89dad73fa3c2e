// The lines of level rotating sensors. All layers share one line per azimuth step (docs/model.md
// section 5). The lines are cached as in beam_lines.hpp, but each azimuth step has its own slot.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "grid/beam_lines.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// The properties of a layer that do not depend on the azimuth. `range_share` is the ratio of
// horizontal range to range. `in_band` contains the horizontal ranges at which the layer is within
// the height band. `clears_mm` is the horizontal range up to which the layer carves if there is no
// echo. `band` is the part of the line within the height band.
struct alignas(64) TurnLayer {
  std::uint32_t range_share = 0;  // as in vehicle::Layer
  vehicle::Ranges in_band;
  std::uint32_t clears_mm = 0;
  // The layers are ranked by the distance at which they leave the band. The layer that leaves the
  // band farthest from the sensor has rank 0.
  std::uint32_t rank = 0;
  // A point at this range or beyond frees the line from the sensor to where the layer leaves the
  // band. If the sensor is outside the band, behind_mm has the maximum value of its type.
  std::uint32_t behind_mm = std::numeric_limits<std::uint32_t>::max();
  BandLimits band;
};

// All layers of a sensor.
struct TurnLayers {
  // True if the sensor is within the height band. In this case, a beam that ends within the band
  // never leaves it, and each layer's part within the band contains the parts of all layers with
  // higher ranks.
  bool start_in_band = false;
  // The number of beams needed to saturate a cell.
  std::uint32_t enough_beams = 0;
  // A hit at this distance or beyond frees all cells in the band that layers with rank near_rank or
  // higher can free.
  std::uint32_t far_mm = 0;
  std::uint32_t near_rank = 0;
  std::uint32_t zones_mm = 0;  // BandLimits::behind_mm()
  std::array<std::uint8_t, vehicle::kMaxLayers> by_rank{};
  std::array<TurnLayer, vehicle::kMaxLayers> layers{};
  // `tall` contains the horizontal ranges at which each layer's returns are tall returns. `low` is
  // the part of the line in which each layer's beams are low beams. Both are computed from
  // vehicle::Sensor::moved.
  std::array<vehicle::Ranges, vehicle::kMaxLayers> tall{};
  std::array<BandLimits, vehicle::kMaxLayers> low{};
};

class TurnLines {
 public:
  explicit TurnLines(const vehicle::Vehicle& vehicle);

  // Returns the horizontal ranges at which a point on the line is on the car itself. The ranges are
  // computed on first use. The sensor must belong to the vehicle, and its layers must share lines.
  [[nodiscard]] const vehicle::Ranges& on_car(const vehicle::Sensor& sensor,
                                              std::uint32_t azimuth_step) {
    const std::uint32_t place = first_[number_of(sensor)] + azimuth_step;
    if (!on_car_[place].is_known) {
      find(sensor, azimuth_step, place);
    }
    return on_car_[place].ranges;
  }
  // Returns the line of this azimuth step. Call on_car() first.
  [[nodiscard]] KeptLine& line(const vehicle::Sensor& sensor, std::uint32_t azimuth_step) {
    return lines_[first_[number_of(sensor)] + azimuth_step];
  }
  // The layers of this sensor.
  [[nodiscard]] const TurnLayers& layers_of(const vehicle::Sensor& sensor) const {
    return layers_[number_of(sensor)];
  }

 private:
  // A turn visits all lines, and the caches cannot hold them all, so each line is fetched from
  // memory again in each turn. The first point of a line needs the ranges on the car, but the line
  // itself is needed only for carving. The ranges are therefore stored separately, next to the
  // ranges of neighbouring lines.
  struct OnCar {
    vehicle::Ranges ranges;
    bool is_known = false;
  };

  [[gnu::noinline]] void find(const vehicle::Sensor& sensor, std::uint32_t azimuth_step,
                              std::uint32_t place);
  [[nodiscard]] std::size_t number_of(const vehicle::Sensor& sensor) const {
    return static_cast<std::size_t>(&sensor - first_sensor_);
  }

  const vehicle::Sensor* first_sensor_;
  std::array<std::uint32_t, vehicle::kMaxSensors> first_{};  // each sensor's first slot
  std::array<TurnLayers, vehicle::kMaxSensors> layers_{};
  std::array<OnCar, vehicle::kMaxTurnLines> on_car_{};
  std::array<KeptLine, vehicle::kMaxTurnLines> lines_;
};

}  // namespace iog::grid
