// The lines of level sensors that turn: one for each azimuth step, for all layers
// (docs/model.md section 5). They are kept like those of beam_lines.hpp, and as there are no more
// azimuths than steps, each has a place of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "grid/beam_lines.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// What the beams of a layer have in common, whatever their azimuth: the share of a range that is
// along the line, the ranges along the line that are in the height band, how far along it they
// carve without an echo, and the part of the line that is in the band.
struct alignas(64) TurnLayer {
  std::uint32_t range_share = 0;  // as in vehicle::Layer
  vehicle::Ranges in_band;
  std::uint32_t clears_mm = 0;
  // Among the sensor's layers, the one that is farthest in the band first.
  std::uint32_t rank = 0;
  // From here on a point is so far behind the band that it frees all of the line from the sensor to
  // where the layer leaves the band; nowhere if the sensor is not in the band.
  std::uint32_t behind_mm = std::numeric_limits<std::uint32_t>::max();
  BandLimits band;
};

// The layers of a sensor.
struct TurnLayers {
  // Whether the sensor is in the height band. Then a beam that ends in the band is there from its
  // start, and what a layer has in the band is part of what each layer of lower rank has.
  bool start_in_band = false;
  // So many beams make a cell as free as it can be.
  std::uint32_t enough_beams = 0;
  // Hits at this distance and beyond free all that layers of this rank and above have in the band.
  std::uint32_t far_mm = 0;
  std::uint32_t near_rank = 0;
  std::uint32_t zones_mm = 0;  // BandLimits::behind_mm()
  std::array<std::uint8_t, vehicle::kMaxLayers> by_rank{};
  std::array<TurnLayer, vehicle::kMaxLayers> layers{};
  // By vehicle::Sensor::moved: the ranges along the line at which a return of a layer is tall, and
  // the part of the line in which its beams are low.
  std::array<vehicle::Ranges, vehicle::kMaxLayers> tall{};
  std::array<BandLimits, vehicle::kMaxLayers> low{};
};

class TurnLines {
 public:
  explicit TurnLines(const vehicle::Vehicle& vehicle);

  // Of one of the vehicle's sensors whose layers share lines: the ranges along a line that end on
  // the car itself. It is found if it has to be.
  [[nodiscard]] const vehicle::Ranges& on_car(const vehicle::Sensor& sensor,
                                              std::uint32_t azimuth_step) {
    const std::uint32_t place = first_[number_of(sensor)] + azimuth_step;
    if (!on_car_[place].is_known) {
      find(sensor, azimuth_step, place);
    }
    return on_car_[place].ranges;
  }
  // That line, only after its ranges.
  [[nodiscard]] KeptLine& line(const vehicle::Sensor& sensor, std::uint32_t azimuth_step) {
    return lines_[first_[number_of(sensor)] + azimuth_step].line;
  }
  // Its layers.
  [[nodiscard]] const TurnLayers& layers_of(const vehicle::Sensor& sensor) const {
    return layers_[number_of(sensor)];
  }

 private:
  // As a turn comes by all lines, each is fetched from memory anew: these ranges when its first
  // point comes, with those of its neighbours, and the line itself when it is carved.
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
  std::array<std::uint32_t, vehicle::kMaxSensors> first_{};  // each sensor's first place
  std::array<TurnLayers, vehicle::kMaxSensors> layers_{};
  std::array<OnCar, vehicle::kMaxTurnLines> on_car_{};
  std::array<Line, vehicle::kMaxTurnLines> lines_;
};

}  // namespace iog::grid
