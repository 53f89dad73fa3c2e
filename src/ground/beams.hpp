// Computes the sector, the distance and the height of a spinning sensor's returns.
//
// If a sensor is mounted level, all of its layers share one line per azimuth, and the slope of each
// beam is the tangent of its elevation (docs/model.md section 5). If a sensor is tilted, its bins
// lie in its plane of rotation. Heights in these bins are measured from the car's plane, along the
// car's vertical axis. Straight ground therefore remains straight.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ground/bins.hpp"
#include "lidar/sampling.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::ground {

// The slope of a beam in units of 2^-24. Even a slope of 89 degrees fits into one word.
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
  // Returns the distance from the sensor in its plane of rotation, rounded down. For a level
  // sensor, the result is the distance along the line.
  [[nodiscard]] std::uint32_t out_mm(std::size_t layer, std::uint32_t range_mm) const {
    return vehicle::along_line_mm(range_mm, shares_[layer]);
  }

  // Returns the slope of a beam along its line, rounded down. `end_z` is the height of the beam's
  // end in subcells. The beam ends at the sensor's range along the line.
  [[nodiscard]] Slope slope_to(std::int32_t end_z) const;
  // Returns the height above the car's plane at a distance along a beam's line, rounded down.
  // Requires |rise| < 2^30.
  [[nodiscard]] std::int32_t height_mm(Slope rise, std::uint32_t along_mm) const {
    const std::int64_t product =
        std::int64_t{rise} * (static_cast<std::int32_t>(along_mm) << (32 - kSlopeFractionBits));
    return origin_mm_ + static_cast<std::int32_t>(product >> 32);
  }
  // Converts a beam's slope along its line to its slope in the plane of rotation, rounded down.
  [[nodiscard]] Slope slope_out(std::size_t layer, Slope rise) const {
    return static_cast<Slope>((std::int64_t{rise} * along_of_out_[layer]) >> kAlongBits);
  }
  // Converts a distance in the plane of rotation to the distance along the beam's line, rounded
  // down.
  [[nodiscard]] std::uint32_t along_mm(std::size_t layer, std::uint32_t out_mm) const {
    return static_cast<std::uint32_t>((std::uint64_t{out_mm} * along_of_out_[layer]) >> kAlongBits);
  }
  // Returns the slope of the beams of a layer. The slope is valid only for level sensors.
  [[nodiscard]] Slope slope(std::size_t layer) const { return slopes_[layer]; }
  [[nodiscard]] std::int32_t origin_mm() const { return origin_mm_; }

  // Returns the length of the sensor's lines.
  [[nodiscard]] std::uint32_t range_mm() const { return range_mm_; }
  // Returns all layers, sorted by ascending elevation.
  [[nodiscard]] std::span<const std::uint8_t> from_below() const {
    return std::span(from_below_).first(layer_count_);
  }
  // Returns which points of a packet are used to estimate the car's tilt. These points are in every
  // second layer of the lower two thirds of the layers. The number of firings is chosen so that
  // there are kSamples points.
  [[nodiscard]] lidar::Sampling sampling() const {
    return {.layers = std::span(sampled_).first(sampled_count_), .log2_firings = log2_firings_};
  }
  // Returns the minimum number of samples that a packet must have for the tilt to be estimated.
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
