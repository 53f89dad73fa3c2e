// Where the returns of a sensor that turns lie around it: in which sector, how far out, how high.
//
// Of a level sensor, all layers of an azimuth go along its line and rise by the tangent of their
// elevation (docs/model.md section 5). Of a tilted one, bins lie in the plane in which it turns,
// and heights are those over the car's plane, in the direction of its axis: what is straight ground
// stays straight.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ground/bins.hpp"
#include "lidar/sampling.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::ground {

// How much a beam rises, in 2^-24: of one of 89 degrees it fits a word.
using Slope = std::int32_t;
inline constexpr int kSlopeFractionBits = 24;

class Beams {
 public:
  Beams() = default;
  // Of a sensor that turns.
  explicit Beams(const vehicle::Sensor& sensor);

  [[nodiscard]] Bins bins() const { return bins_; }
  [[nodiscard]] std::uint32_t sector_of(std::uint32_t azimuth_step) const {
    return azimuth_step >> sector_shift_;
  }
  // Its distance outward, rounded down. Of a level sensor it is that along its line.
  [[nodiscard]] std::uint32_t out_mm(std::size_t layer, std::uint32_t range_mm) const {
    return vehicle::along_line_mm(range_mm, shares_[layer]);
  }

  // By the height of a beam's end, which is the sensor's range along its line away: how much the
  // beam rises along the line, rounded down.
  [[nodiscard]] Slope slope_to(std::int32_t end_z) const;
  // The height over the car's plane of what lies so far along a beam's line, rounded down.
  // |rise| < 2^30.
  [[nodiscard]] std::int32_t height_mm(Slope rise, std::uint32_t along_mm) const {
    const std::int64_t product =
        std::int64_t{rise} * (static_cast<std::int32_t>(along_mm) << (32 - kSlopeFractionBits));
    return origin_mm_ + static_cast<std::int32_t>(product >> 32);
  }
  // Of a beam that rises so much along its line: how much outward, rounded down.
  [[nodiscard]] Slope slope_out(std::size_t layer, Slope rise) const {
    return static_cast<Slope>((std::int64_t{rise} * along_of_out_[layer]) >> kAlongBits);
  }
  // How far along its line a beam is that is so far out, rounded down.
  [[nodiscard]] std::uint32_t along_mm(std::size_t layer, std::uint32_t out_mm) const {
    return static_cast<std::uint32_t>((std::uint64_t{out_mm} * along_of_out_[layer]) >> kAlongBits);
  }
  // Of a layer, if the sensor is level.
  [[nodiscard]] Slope slope(std::size_t layer) const { return slopes_[layer]; }
  [[nodiscard]] std::int32_t origin_mm() const { return origin_mm_; }

  // How long a line is.
  [[nodiscard]] std::uint32_t range_mm() const { return range_mm_; }
  // All layers, those that look down most first.
  [[nodiscard]] std::span<const std::uint8_t> from_below() const {
    return std::span(from_below_).first(layer_count_);
  }
  // Of a packet, the points that say how the car is tilted: of every second layer of the lower two
  // thirds, in firings enough for kSamples.
  [[nodiscard]] lidar::Sampling sampling() const {
    return {.layers = std::span(sampled_).first(sampled_count_), .log2_firings = log2_firings_};
  }
  // So few samples of a packet say nothing.
  [[nodiscard]] std::int32_t fewest_samples() const { return fewest_samples_; }

 private:
  static constexpr std::size_t kSamples = 44;
  static constexpr int kAlongBits = 16;

  void sort_layers(const vehicle::Sensor& sensor);

  Bins bins_;
  std::uint32_t range_mm_ = 0;
  int sector_shift_ = 0;
  std::int32_t origin_mm_ = 0;
  std::int32_t origin_z_ = 0;           // in subcells
  std::uint64_t slope_of_subcell_ = 0;  // of a height at the end of a line, in 2^-40
  std::array<std::uint32_t, vehicle::kMaxLayers> shares_{};
  std::array<std::uint32_t, vehicle::kMaxLayers> along_of_out_{};  // 1 / shares_, in 2^-16
  std::array<Slope, vehicle::kMaxLayers> slopes_{};
  std::size_t layer_count_ = 0;
  std::array<std::uint8_t, vehicle::kMaxLayers> from_below_{};
  std::array<std::uint8_t, vehicle::kMaxLayers> sampled_{};
  std::size_t sampled_count_ = 0;
  int log2_firings_ = 0;
  std::int32_t fewest_samples_ = 0;
};

}  // namespace iog::ground
