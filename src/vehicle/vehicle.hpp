// A vehicle as the target knows it: integers only, computed by the compiler from a description.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "geometry/cell.hpp"
#include "lidar/ibeo_lux.hpp"
#include "lidar/velodyne_vlp16.hpp"
#include "numeric/reciprocal.hpp"
#include "numeric/sine_table.hpp"
#include "sensor_model/profile.hpp"
#include "vehicle/beam_line.hpp"
#include "vehicle/description.hpp"

namespace iog::vehicle {

inline constexpr std::size_t kMaxSensors = 8;
inline constexpr std::size_t kMaxLayers = 16;

// Coefficients of a beam's end carry this many bits below one subcell. 10 is what fits: a line of
// 2^20 subcells times 2^10 is 2^30, times a sine of 2^30 is 2^60, and three such terms stay below
// 2^62. The end is within 0.002 subcells of the real one before it is rounded.
inline constexpr int kAxisFractionBits = 10;

// One coordinate of the end of every beam of a layer, as a function of azimuth a:
//   end = base + forward cos a + left sin a      in units of 2^-10 subcells.
struct EndCoordinate {
  std::int64_t base = 0;
  std::int32_t forward = 0;
  std::int32_t left = 0;
  friend constexpr bool operator==(const EndCoordinate&, const EndCoordinate&) = default;
};

struct Layer {
  EndCoordinate x;
  EndCoordinate y;
  EndCoordinate z;
  // The first layer whose beams have the same lines on the grid. Two layers of opposite elevations
  // share their lines if the sensor is level.
  std::uint8_t line = 0;
};

// Whether a point on a beam lies in some part of space, asked without a division: along one axis
// the product of the beam's extent in subcells and the range in millimetres must lie between these
// two, both included.
struct RangeProducts {
  std::int64_t low = 0;
  std::int64_t high = 0;
  [[nodiscard]] constexpr bool contain(std::int32_t extent, std::uint32_t range_mm) const {
    const std::int64_t product = std::int64_t{extent} * static_cast<std::int32_t>(range_mm);
    return low <= product && product <= high;
  }
};

struct Sensor {
  std::string_view name;
  lidar::Format format = lidar::Format::kIbeoLux;
  std::uint32_t source_ipv4 = 0;
  std::uint16_t udp_port = 0;
  geometry::SubcellPoint origin;  // S, in grid subcells
  std::int32_t origin_z = 0;      // height in subcells
  std::uint8_t layer_count = 0;
  std::array<Layer, kMaxLayers> layers{};
  numeric::SineTable sines;
  traversal::LineLength range;  // L
  std::uint32_t range_min_mm = 0;
  std::uint32_t precision_mm = 1;  // Delta
  numeric::Reciprocal precision;   // divides by Delta
  std::uint32_t no_return_clears_mm = 0;
  std::uint16_t scan_width_ticks = 0;
  std::uint32_t max_points_per_scan = 0;
  sensor_model::Profile profile;
  RangeProducts on_car_x;  // together: within the vehicle's footprint
  RangeProducts on_car_y;
  RangeProducts in_band;  // within its height band
};

// A rectangle in subcells, both ends included.
struct Footprint {
  std::int32_t x_min = 0;
  std::int32_t x_max = 0;
  std::int32_t y_min = 0;
  std::int32_t y_max = 0;
};

struct Vehicle {
  std::string_view name;
  std::span<const Sensor> sensors;
  Footprint footprint;
  std::int32_t z_min = 0;  // the height band in subcells, both ends included
  std::int32_t z_max = 0;
  FusionRule rule = FusionRule::kHitsWin;
  std::uint32_t frame_period_us = 0;
};

}  // namespace iog::vehicle
