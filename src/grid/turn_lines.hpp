// The lines of level rotating sensors: one line per azimuth step, shared by all layers
// (docs/model.md section 5). They are cached like those of beam_lines.hpp, but each azimuth step
// has a slot of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "grid/beam_lines.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// Properties of a layer that do not depend on the azimuth: the share of a range along the line, the
// ranges along the line within the height band, the range along the line that it carves without an
// echo, and the part of the line in the band.
struct alignas(64) TurnLayer {
  std::uint32_t range_share = 0;  // as in vehicle::Layer
  vehicle::Ranges in_band;
  std::uint32_t clears_mm = 0;
  // Exit order among the sensor's layers: the layer that stays in the band farthest has rank 0.
  std::uint32_t rank = 0;
  // A point at this range or beyond lies far behind the band. It frees the whole line from the
  // sensor to where the layer leaves the band. The maximum if the sensor is not in the band.
  std::uint32_t behind_mm = std::numeric_limits<std::uint32_t>::max();
  BandLimits band;
};

// All layers of a sensor.
struct TurnLayers {
  // Whether the sensor is in the height band. If so, a beam that ends in the band is in it from the
  // start. A layer's part in the band then lies within that of each layer of lower rank.
  bool start_in_band = false;
  // The number of beams that saturates a cell.
  std::uint32_t enough_beams = 0;
  // Hits at this distance or beyond free everything that layers of near_rank and above have in the
  // band.
  std::uint32_t far_mm = 0;
  std::uint32_t near_rank = 0;
  std::uint32_t zones_mm = 0;  // BandLimits::behind_mm()
  std::array<std::uint8_t, vehicle::kMaxLayers> by_rank{};
  std::array<TurnLayer, vehicle::kMaxLayers> layers{};
  // By vehicle::Sensor::moved: the ranges along the line at which a layer's return is tall, and the
  // part of the line in which its beams are low.
  std::array<vehicle::Ranges, vehicle::kMaxLayers> tall{};
  std::array<BandLimits, vehicle::kMaxLayers> low{};
};

class TurnLines {
 public:
  explicit TurnLines(const vehicle::Vehicle& vehicle);

  // The ranges along a line that end on the car itself, computed on first use. The sensor must be
  // one of the vehicle's whose layers share lines.
  [[nodiscard]] const vehicle::Ranges& on_car(const vehicle::Sensor& sensor,
                                              std::uint32_t azimuth_step) {
    const std::uint32_t place = first_[number_of(sensor)] + azimuth_step;
    if (!on_car_[place].is_known) {
      find(sensor, azimuth_step, place);
    }
    return on_car_[place].ranges;
  }
  // That line. Call on_car() first.
  [[nodiscard]] KeptLine& line(const vehicle::Sensor& sensor, std::uint32_t azimuth_step) {
    return lines_[first_[number_of(sensor)] + azimuth_step].line;
  }
  // Its layers.
  [[nodiscard]] const TurnLayers& layers_of(const vehicle::Sensor& sensor) const {
    return layers_[number_of(sensor)];
  }

 private:
  // A turn visits all lines, so each is fetched from memory again. The ranges, with those of
  // neighbouring lines, are needed at a line's first point. The line itself is needed only when it
  // is carved. So they are stored apart.
  struct OnCar {
    vehicle::Ranges ranges;
    bool is_known = false;
  };
  struct alignas(32) Line {
    KeptLine line;
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
  std::array<Line, vehicle::kMaxTurnLines> lines_;
};

}  // namespace iog::grid
