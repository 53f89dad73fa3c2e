// The lines of level sensors that turn: one for each azimuth step, for all layers
// (docs/model.md section 5). They are kept like those of beam_lines.hpp, and as there are no more
// azimuths than steps, each has a place of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "grid/beam_lines.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// The line of an azimuth step, and the ranges along it that end on the car itself. As a turn comes
// by all lines, each is fetched from memory anew: once when its first point comes, and once when it
// is carved.
struct alignas(32) TurnLine {
  vehicle::Ranges on_car;
  bool is_found = false;
  KeptLine line;
};

// What the beams of a layer have in common, whatever their azimuth: the share of a range that is
// along the line, the ranges along the line that are in the height band, how far along it they
// carve without an echo, and the part of the line that is in the band.
struct alignas(64) TurnLayer {
  std::uint32_t range_share = 0;  // as in vehicle::Layer
  vehicle::Ranges in_band;
  std::uint32_t clears_mm = 0;
  BandLimits band;
};

// A beam of such a sensor, as the carver asks of it.
class TurnBeam {
 public:
  TurnBeam(const KeptLine& line, const TurnLayer& layer) : line_(&line), layer_(&layer) {}

  [[nodiscard]] const KeptLine& line() const { return *line_; }
  [[nodiscard]] std::uint32_t clears_mm() const { return layer_->clears_mm; }
  [[nodiscard]] LinePart in_band(const vehicle::Vehicle& /*vehicle*/,
                                 const vehicle::Sensor& /*sensor*/) const {
    return line_->in_band(layer_->band);
  }
  [[nodiscard]] std::uint32_t is_free_before_mm() const { return layer_->band.is_free_before_mm(); }

 private:
  const KeptLine* line_;
  const TurnLayer* layer_;
};

class TurnLines {
 public:
  explicit TurnLines(const vehicle::Vehicle& vehicle);

  // Of one of the vehicle's sensors, whose layers share lines: its lines by azimuth step, and its
  // layers.
  [[nodiscard]] TurnLine* lines_of(const vehicle::Sensor& sensor) {
    return &lines_[first_[number_of(sensor)]];
  }
  [[nodiscard]] const TurnLayer* layers_of(const vehicle::Sensor& sensor) const {
    return layers_[number_of(sensor)].data();
  }

  // Finds a line, once.
  [[gnu::noinline]] static void find(const vehicle::Sensor& sensor, std::uint32_t azimuth_step,
                                     TurnLine& line);

  // Forgets all lines, as after the start: each has to be found again.
  void forget();

 private:
  [[nodiscard]] std::size_t number_of(const vehicle::Sensor& sensor) const {
    return static_cast<std::size_t>(&sensor - first_sensor_);
  }

  const vehicle::Sensor* first_sensor_;
  std::array<std::uint32_t, vehicle::kMaxSensors> first_{};  // each sensor's first place
  std::array<std::array<TurnLayer, vehicle::kMaxLayers>, vehicle::kMaxSensors> layers_{};
  std::array<TurnLine, vehicle::kMaxTurnLines> lines_;
};

}  // namespace iog::grid
