// The target's description of a vehicle, which contains only integers. The PC computes this
// description from a car file (tools/car). The target reads the description from the block in its
// image (src/car_block).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "geometry/cell.hpp"
#include "geometry/grid.hpp"
#include "lidar/formats.hpp"
#include "lidar/laser.hpp"
#include "lidar/unit.hpp"
#include "map/source_description.hpp"
#include "numeric/reciprocal.hpp"
#include "numeric/sine_table.hpp"
#include "perception/rules.hpp"
#include "pose/source_description.hpp"
#include "sensor_model/arc.hpp"
#include "sensor_model/profile.hpp"
#include "vehicle/azimuth_steps.hpp"
#include "vehicle/beam_line.hpp"

namespace iog::vehicle {

inline constexpr std::size_t kMaxSensors = 8;
inline constexpr std::size_t kMaxLayers = 128;
inline constexpr std::size_t kMaxGroundSensors = 2;  // sensors that follow the ground

inline constexpr std::uint16_t kUsualEpsilonE5 = 5'000;  // unless the car file specifies a value

// The maximum number of cached lines for all level rotating sensors of a vehicle together. Each
// azimuth step has one line, which takes about 0.7 KB.
inline constexpr std::size_t kMaxTurnLines = 8192;

// The coefficients in EndCoordinate are in subcells, with this many fraction bits. The maximum is
// 10: a line can be 2^20 subcells long, so a coefficient can reach 2^20 * 2^10 = 2^30. The product
// of a coefficient and a sine is at most 2^60, so the sum of three such terms is below 2^62. Before
// rounding, the computed end is within 0.002 subcells of the exact one.
inline constexpr int kAxisFractionBits = 10;

// Coefficients that are valid for all beams of a layer. For a beam with the azimuth `a`, they give
// one coordinate of the beam's end:
//   end = base + forward * cos(a) + left * sin(a)      in units of 2^-10 subcells.
struct EndCoordinate {
  std::int64_t base = 0;
  std::int32_t forward = 0;
  std::int32_t left = 0;
  friend constexpr bool operator==(const EndCoordinate&, const EndCoordinate&) = default;
};

// Returns the horizontal range, which is `range_mm` times `share`, rounded down. `share` is in
// units of 2^-30. The range is below 2^30 and is shifted left by 2, so the result is the upper word
// of one 32 x 32-bit product.
[[nodiscard]] constexpr std::uint32_t along_line_mm(std::uint32_t range_mm, std::uint32_t share) {
  const std::uint32_t scaled = range_mm << (32 - numeric::kSineFractionBits);
  const std::uint64_t product = std::uint64_t{scaled} * share;
  return static_cast<std::uint32_t>(product >> 32);
}

struct Layer {
  EndCoordinate x;
  EndCoordinate y;
  EndCoordinate z;
  // The index of the first layer that has the same lines on the grid. If the sensor is level, two
  // layers with opposite elevations share their lines.
  std::uint8_t line = 0;
  // The ratio of the horizontal range to the measured range, in units of 2^-30. If all layers use
  // the line for elevation 0, this ratio is the cosine of the layer's elevation. Otherwise, the
  // ratio is 1.
  std::uint32_t range_share = std::uint32_t{1} << numeric::kSineFractionBits;

  [[nodiscard]] constexpr std::uint32_t along_line_mm(std::uint32_t range_mm) const {
    return vehicle::along_line_mm(range_mm, range_share);
  }
};

// The limits of a region along one axis. A point on a beam is inside if the product of the beam's
// extent in subcells and the range in mm is between these limits. Both limits are inclusive.
struct RangeProducts {
  std::int64_t low = 0;
  std::int64_t high = 0;
};

// A return is an obstacle if its height above the ground is between these limits (docs/ground.md).
// Both limits are inclusive. If the limits are not set, the sensor does not follow the ground and
// uses its vehicle's height band.
struct GroundLimits {
  std::uint16_t low_mm = 0;
  std::uint16_t top_mm = 0;

  [[nodiscard]] constexpr bool is_followed() const { return top_mm != 0; }
};

// The limits of free-space gating by low beams (perception/opening.hpp). A beam opens cells only up
// to a height of low_mm. Only a return at a height of at least tall_mm can come from a moving
// object. Heights are measured from the local ground if the sensor follows the ground, and from the
// car's plane otherwise. By default, every beam is low and every return is tall.
struct MovedLimits {
  static constexpr std::uint16_t kAnyHeight = 65'535;
  // If the sensor follows the ground, a beam below this height does not open cells, because it may
  // pass under a stationary car.
  static constexpr std::uint16_t kUnderCarsMm = 300;

  std::uint16_t low_mm = kAnyHeight;
  std::uint16_t tall_mm = 0;

  [[nodiscard]] constexpr bool are_given() const { return low_mm != kAnyHeight || tall_mm != 0; }
};

// The limits for heights above the car's plane, in subcells. Both limits are inclusive.
struct HeightBand {
  std::int32_t low = 0;
  std::int32_t high = 0;
};

struct Sensor {
  std::string_view name;
  lidar::Format format = lidar::kFormat<lidar::IbeoLux>;
  std::uint32_t source_ipv4 = 0;
  std::uint16_t udp_port = 0;
  geometry::SubcellPoint origin;  // S, grid subcells
  std::int32_t origin_z = 0;      // height in subcells
  std::uint8_t layer_count = 0;
  bool layers_share_lines = false;  // rotating and level: all layers share one line per azimuth
  AzimuthSteps azimuths;
  numeric::SineTable sines;     // sines of the azimuth steps
  traversal::LineLength range;  // L
  std::uint32_t range_min_mm = 0;
  std::uint32_t precision_mm = 1;  // Delta
  numeric::Reciprocal precision;   // divides by Delta
  std::uint32_t no_return_clears_mm = 0;
  std::uint16_t scan_width_ticks = 0;
  std::uint32_t max_points_per_scan = 0;
  GroundLimits ground;
  MovedLimits moved;
  // If a beam ends on the ground, this is the fraction of its length that is above the lower limit
  // of the height band, in units of 2^-30. Heights are measured from a straight line between the
  // ground below the sensor and the end of the beam. The fraction is 1 if the sensor is below the
  // band's lower limit or looks over objects.
  std::uint32_t share_over_ground = std::uint32_t{1} << numeric::kSineFractionBits;
  // True if the car file contains the manufacturer's calibration of each laser.
  bool is_calibrated = false;
  // columns_per_turn and column_ns are used only for Ouster sensors (see lidar::Unit).
  std::uint16_t columns_per_turn = 0;
  std::uint32_t column_ns = 0;
  bool is_synchronised = false;  // its clock is the pose source's clock
  std::uint32_t latency_us = 0;  // delay from measurement to arrival, if it is not synchronised
  sensor_model::Profile profile;
  sensor_model::Arc arc{};  // only for radars and ultrasonic sensors
  RangeProducts on_car_x;   // together with on_car_y: inside the vehicle's footprint
  RangeProducts on_car_y;
  RangeProducts in_band;  // inside the height band
  RangeProducts tall;     // inside the part of the band with tall returns
  geometry::Grid grid;    // that of the car
  // Large members come last to keep the other members close together.
  std::array<Layer, kMaxLayers> layers{};
  std::array<lidar::LaserCorrection, kMaxLayers> laser_corrections{};
  std::array<std::int32_t, kMaxLayers> elevations{};  // only for a sensor that sends points

  // Returns the unit's description, which contains views of members of this sensor.
  [[nodiscard]] constexpr lidar::Unit unit() const {
    return {.corrections = std::span(laser_corrections).first(is_calibrated ? layer_count : 0),
            .elevations = std::span(elevations).first(layer_count),
            .columns_per_turn = columns_per_turn,
            .column_ns = column_ns};
  }
};

// The grids that the target sends: occupancy indexes around the vehicle, or classes in the
// world-aligned window (docs/perception.md).
enum class Grids : std::uint8_t { kIndexes, kClasses, kBoth };

[[nodiscard]] constexpr bool have_indexes(Grids grids) { return grids != Grids::kClasses; }
[[nodiscard]] constexpr bool have_classes(Grids grids) { return grids != Grids::kIndexes; }

// The two fusion rules of docs/model.md section 3.
enum class FusionRule : std::uint8_t { kHitsWin, kBayes };

// A rectangle in subcells, including its edges.
struct Footprint {
  std::int32_t x_min = 0;
  std::int32_t x_max = 0;
  std::int32_t y_min = 0;
  std::int32_t y_max = 0;
};

struct Vehicle {
  std::string_view name;
  std::uint32_t id = 0;  // CRC of the name and of all members below (car_block/content.hpp)
  std::span<const Sensor> sensors;
  geometry::Grid grid{};
  Footprint footprint{};
  std::int32_t z_min = 0;  // lower limit of the height band in subcells; both limits are included
  std::int32_t z_max = 0;

  [[nodiscard]] constexpr HeightBand band() const { return {z_min, z_max}; }
  // Returns the part of the height band in which the sensor's beams are low.
  [[nodiscard]] constexpr HeightBand low_band(const Sensor& sensor) const {
    return {z_min, sensor.moved.low_mm == MovedLimits::kAnyHeight
                       ? z_max
                       : std::min(z_max, grid.subcells(sensor.moved.low_mm))};
  }

  FusionRule rule = FusionRule::kHitsWin;
  index::Quantisation quantisation = index::Quantisation::kBlurring;
  std::uint16_t epsilon_e5 = kUsualEpsilonE5;  // epsilon of the recursive set in 1e-5
  std::uint32_t frame_period_us = 0;
  Grids grids = Grids::kIndexes;
  bool has_objects = false;  // tracks objects on the class grid (docs/objects.md)
  pose::SourceDescription poses{};
  map::SourceDescription maps{};
  perception::Rules window{};

  // Returns true if the classes depend on packet arrival times. This is the case if at least one
  // sensor's clock is not the pose source's clock.
  [[nodiscard]] constexpr bool depends_on_arrival() const {
    return have_classes(grids) && !std::ranges::all_of(sensors, &Sensor::is_synchronised);
  }
};

}  // namespace iog::vehicle
