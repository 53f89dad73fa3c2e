// Computes the sector, distance and height of each return from a spinning sensor.
//
// The layers of a level sensor share one line per azimuth, and the slope of each beam is the
// tangent of its elevation (docs/model.md section 5). The bins of a tilted sensor lie in its plane
// of rotation. Heights in these bins are measured from the car's plane, along the car's vertical
// axis. Straight ground therefore remains straight.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ground/bins.hpp"
#include "lidar/sampling.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::ground {

// The slope of a beam in units of 2^-24. Even a slope of 89 degrees fits in one word.
using Slope = std::int32_t;
inline constexpr int kSlopeFractionBits = 24;

class Beams {
 public:
  Beams() = default;
  // The sensor must be a spinning lidar.
  explicit Beams(const vehicle::Sensor& sensor);

  [[nodiscard]] Bins bins() const { return bins_; }
  [[nodiscard]] std::uint32_t sector_of(std::uint32_t azimuth_step) const {
    return azimuth_step >> sector_shift_;
  }
  // Converts a range to a distance in the sensor's plane of rotation, rounded down. For a level
  // sensor, the result is the distance along the line.
  [[nodiscard]] std::uint32_t out_mm(std::size_t layer, std::uint32_t range_mm) const {
    return vehicle::along_line_mm(range_mm, shares_[layer]);
  }

  // Returns the slope of a beam along its line, rounded down. `end_z` is the beam's height, in
  // subcells, at the end of its line.
  [[nodiscard]] Slope slope_to(std::int32_t end_z) const;
  // Returns a beam's height above the car's plane, rounded down. `rise` is the beam's slope along
  // its line, and `along_mm` is the distance along this line. Requires |rise| < 2^30.
  [[nodiscard]] std::int32_t height_mm(Slope rise, std::uint32_t along_mm) const {
    const std::int64_t product =
        std::int64_t{rise} * (static_cast<std::int32_t>(along_mm) << (32 - kSlopeFractionBits));
    return origin_mm_ + static_cast<std::int32_t>(product >> 32);
  }
  // Converts a slope along a beam's line to the slope in the plane of rotation, rounded down.
  [[nodiscard]] Slope slope_out(std::size_t layer, Slope rise) const {
    return static_cast<Slope>((std::int64_t{rise} * along_of_out_[layer]) >> kAlongBits);
  }
  // Converts a distance in the plane of rotation to the distance along the beam's line, rounded
  // down.
  [[nodiscard]] std::uint32_t along_mm(std::size_t layer, std::uint32_t out_mm) const {
    return static_cast<std::uint32_t>((std::uint64_t{out_mm} * along_of_out_[layer]) >> kAlongBits);
  }
  // Returns the slope of a layer's beams. The slope is valid only for level sensors.
  [[nodiscard]] Slope slope(std::size_t layer) const { return slopes_[layer]; }
  [[nodiscard]] std::int32_t origin_mm() const { return origin_mm_; }

  // Returns the length of the sensor's lines.
  [[nodiscard]] std::uint32_t range_mm() const { return range_mm_; }
  // Returns all layers, sorted by ascending elevation.
  [[nodiscard]] std::span<const std::uint8_t> from_below() const {
    return std::span(from_below_).first(layer_count_);
  }
  // Returns which of a packet's points are used to estimate the car's tilt. The upper third of the
  // layers and every other layer below it are skipped. The number of firings is the smallest power
  // of two that yields at least kSamples points.
  [[nodiscard]] lidar::Sampling sampling() const {
    return {.layers = std::span(sampled_).first(sampled_count_), .log2_firings = log2_firings_};
  }
  // Returns the minimum number of samples needed to estimate the tilt.
  [[nodiscard]] std::int32_t fewest_samples() const { return fewest_samples_; }

 private:
  static constexpr std::size_t kSamples = 44;
  static constexpr int kAlongBits = 16;

  void sort_layers(const vehicle::Sensor& sensor);

  Bins bins_;
  std::uint32_t range_mm_ = 0;
  int sector_shift_ = 0;
  std::int32_t origin_mm_ = 0;
  std::int32_t origin_z_ = 0;           // height in subcells
  std::uint64_t slope_of_subcell_ = 0;  // slope per subcell of end height, in units of 2^-40
  std::array<std::uint32_t, vehicle::kMaxLayers> shares_{};
  std::array<std::uint32_t, vehicle::kMaxLayers> along_of_out_{};  // 1 / shares_, in units of 2^-16
  std::array<Slope, vehicle::kMaxLayers> slopes_{};
  std::size_t layer_count_ = 0;
  std::array<std::uint8_t, vehicle::kMaxLayers> from_below_{};
  std::array<std::uint8_t, vehicle::kMaxLayers> sampled_{};
  std::size_t sampled_count_ = 0;
  int log2_firings_ = 0;
  std::int32_t fewest_samples_ = 0;
};

}  // namespace iog::ground
