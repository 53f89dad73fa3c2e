// The beams of a sector, as seen from the side.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ground/beams.hpp"
#include "ground/bins.hpp"
#include "numeric/heap_sort.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::ground {

// The layers of a sensor in one sector, sorted by ascending slope. For a tilted sensor, the beams
// in the middle of the sector represent all of the sector's beams.
class Fan {
 public:
  // The beams must be those of the sensor, a spinning lidar, and both must outlive the fan. The
  // sensor's lines must be at most 131,070 mm long.
  Fan(const Beams& beams, const vehicle::Sensor& sensor)
      : beams_(&beams),
        sensor_(&sensor),
        steps_per_sector_(sensor.azimuths.steps_per_turn() / kSectors),
        count_(beams.from_below().size()) {
    std::ranges::copy(beams.from_below(), layers_.begin());
    for (const std::uint8_t layer : layers()) {
      slopes_[layer] = beams.slope(layer);
    }
  }

  // Finds the slopes and their order in a sector below kSectors. For a tilted sensor, call it
  // before layers() and slope(). It does nothing for a level sensor.
  void turn_to(std::uint32_t sector) {
    if (is_level()) {
      return;
    }
    const vehicle::Direction direction =
        vehicle::direction_of(*sensor_, sector * steps_per_sector_ + steps_per_sector_ / 2);
    for (const std::uint8_t layer : layers()) {
      const std::int32_t end_z = vehicle::end_height_of(sensor_->layers[layer], direction);
      slopes_[layer] = beams_->slope_out(layer, beams_->slope_to(end_z));
    }
    numeric::heap_sort(std::span(layers_).first(count_), [&](std::uint8_t a, std::uint8_t b) {
      return slopes_[a] != slopes_[b] ? slopes_[a] < slopes_[b] : a < b;
    });
  }

  [[nodiscard]] const Beams& beams() const { return *beams_; }
  [[nodiscard]] bool is_level() const { return sensor_->layers_share_lines; }
  [[nodiscard]] std::span<const std::uint8_t> layers() const {
    return std::span(layers_).first(count_);
  }
  // Returns how much a layer's beam rises per distance in the plane of rotation.
  [[nodiscard]] Slope slope(std::size_t layer) const { return slopes_[layer]; }
  // Converts a distance in the plane of rotation to the distance along the beam's line, rounded
  // down, at most the line's length. Both are in units of 2 mm.
  [[nodiscard]] std::uint16_t along_2_mm(std::size_t layer, std::uint32_t out_2_mm) const {
    const std::uint32_t along_mm =
        is_level() ? 2 * out_2_mm : beams_->along_mm(layer, 2 * out_2_mm);
    return static_cast<std::uint16_t>(std::min(along_mm, beams_->range_mm()) / 2);
  }

 private:
  const Beams* beams_;
  const vehicle::Sensor* sensor_;
  std::uint32_t steps_per_sector_;
  std::size_t count_;
  std::array<std::uint8_t, vehicle::kMaxLayers> layers_{};
  std::array<Slope, vehicle::kMaxLayers> slopes_{};
};

}  // namespace iog::ground
