// A vehicle as the target knows it: integers only. The PC computes them of a description
// (src/description), the target reads them from the block of its image (src/car_block).
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
inline constexpr std::size_t kMaxGroundSensors = 2;  // that follow the ground

// Lines that are kept of level sensors that turn, of all such sensors of a vehicle together: one
// for each azimuth step. A line takes some 0.7 KB.
inline constexpr std::size_t kMaxTurnLines = 8192;

// Coefficients of a beam's end carry this many bits below one subcell. 10 is what fits: a line of
// 2^20 subcells times 2^10 is 2^30, times a sine of 2^30 is 2^60, and three such terms stay below
// 2^62. The end is within 0.002 subcells of the real one before it is rounded.
inline constexpr int kAxisFractionBits = 10;

// One coordinate of the end of every beam of a layer, as a function of its azimuth a:
//   end = base + forward cos a + left sin a      in units of 2^-10 subcells.
struct EndCoordinate {
  std::int64_t base = 0;
  std::int32_t forward = 0;
  std::int32_t left = 0;
  friend constexpr bool operator==(const EndCoordinate&, const EndCoordinate&) = default;
};

// How far a range gets along a line, rounded down. The share is in units of 2^-30, and the range
// below 2^30, so that the upper word of one product of words is the answer.
[[nodiscard]] constexpr std::uint32_t along_line_mm(std::uint32_t range_mm, std::uint32_t share) {
  const std::uint32_t scaled = range_mm << (32 - numeric::kSineFractionBits);
  const std::uint64_t product = std::uint64_t{scaled} * share;
  return static_cast<std::uint32_t>(product >> 32);
}

struct Layer {
  EndCoordinate x;
  EndCoordinate y;
  EndCoordinate z;
  // The first layer whose beams have the same lines on the grid. Two layers of opposite elevations
  // share their lines if the sensor is level.
  std::uint8_t line = 0;
  // How far along its line a range gets, in units of 2^-30: the cosine of its elevation where all
  // layers share the line of elevation 0, else 1.
  std::uint32_t range_share = std::uint32_t{1} << numeric::kSineFractionBits;

  [[nodiscard]] constexpr std::uint32_t along_line_mm(std::uint32_t range_mm) const {
    return vehicle::along_line_mm(range_mm, range_share);
  }
};

// Where a point on a beam lies in some part of space, along one axis: where the product of the
// beam's extent in subcells and the range in millimetres lies between these two, both included.
struct RangeProducts {
  std::int64_t low = 0;
  std::int64_t high = 0;
};

// Of a sensor that follows the ground: the heights over it at which a return is an obstacle, both
// included (docs/ground.md). Nothing: it keeps to its vehicle's height band.
struct GroundLimits {
  std::uint16_t low_mm = 0;
  std::uint16_t top_mm = 0;

  [[nodiscard]] constexpr bool is_followed() const { return top_mm != 0; }
};

// How low a beam has to be to open ground, and how tall something is that moves, by its returns
// (perception/opening.hpp): over the car's plane, or over the local ground if the sensor follows
// it. As it stands here every beam is low and every return is tall.
struct MovedLimits {
  static constexpr std::uint16_t kAnyHeight = 65'535;
  // A beam that is lower over the ground may pass under a car that stands there, and opens nothing
  // where its sensor follows the ground.
  static constexpr std::uint16_t kUnderCarsMm = 300;

  std::uint16_t low_mm = kAnyHeight;
  std::uint16_t tall_mm = 0;

  [[nodiscard]] constexpr bool are_given() const { return low_mm != kAnyHeight || tall_mm != 0; }
};

// A height over the car's plane in subcells, rounded down.
[[nodiscard]] constexpr std::int32_t subcells_of(std::uint16_t height_mm) {
  return std::int32_t{height_mm} * geometry::kResolution / geometry::kCellMm;
}

// Heights from one to another, both included, in subcells over the car's plane.
struct HeightBand {
  std::int32_t low = 0;
  std::int32_t high = 0;
};

struct Sensor {
  std::string_view name;
  lidar::Format format = lidar::kFormat<lidar::IbeoLux>;
  std::uint32_t source_ipv4 = 0;
  std::uint16_t udp_port = 0;
  geometry::SubcellPoint origin;  // S, in grid subcells
  std::int32_t origin_z = 0;      // height in subcells
  std::uint8_t layer_count = 0;
  bool layers_share_lines = false;  // it turns and is level: one line an azimuth for all layers
  AzimuthSteps azimuths;
  numeric::SineTable sines;     // of the steps
  traversal::LineLength range;  // L
  std::uint32_t range_min_mm = 0;
  std::uint32_t precision_mm = 1;  // Delta
  numeric::Reciprocal precision;   // divides by Delta
  std::uint32_t no_return_clears_mm = 0;
  std::uint16_t scan_width_ticks = 0;
  std::uint32_t max_points_per_scan = 0;
  GroundLimits ground;
  MovedLimits moved;
  // Of a beam that ends on ground: how far along it is over the band's lower end, by the straight
  // line from below the sensor to that ground, in units of 2^-30; all of it if the sensor is not,
  // or looks over things.
  std::uint32_t share_over_ground = std::uint32_t{1} << numeric::kSineFractionBits;
  // Where its maker calibrated each of its lasers.
  bool is_calibrated = false;
  // Of an Ouster, see lidar::Unit.
  std::uint16_t columns_per_turn = 0;
  std::uint32_t column_ns = 0;
  bool is_synchronised = false;  // with the poses
  std::uint32_t latency_us = 0;  // from measurement to arrival, if it is not
  sensor_model::Profile profile;
  sensor_model::Arc arc{};  // of a radar or an ultrasonic unit
  RangeProducts on_car_x;   // together: within the vehicle's footprint
  RangeProducts on_car_y;
  RangeProducts in_band;  // within its height band
  RangeProducts tall;     // the same of those that are tall by `moved`
  // What is long comes last, so that the rest is near.
  std::array<Layer, kMaxLayers> layers{};
  std::array<lidar::LaserCorrection, kMaxLayers> laser_corrections{};
  std::array<std::int32_t, kMaxLayers> elevations{};  // of a unit of points

  // A view of this sensor.
  [[nodiscard]] constexpr lidar::Unit unit() const {
    return {.corrections = std::span(laser_corrections).first(is_calibrated ? layer_count : 0),
            .elevations = std::span(elevations).first(layer_count),
            .columns_per_turn = columns_per_turn,
            .column_ns = column_ns};
  }
};

// Which grids the target sends: of occupancy indexes around the vehicle, of classes in the
// world-aligned window (docs/perception.md).
enum class Grids : std::uint8_t { kIndexes, kClasses, kBoth };

[[nodiscard]] constexpr bool have_indexes(Grids grids) { return grids != Grids::kClasses; }
[[nodiscard]] constexpr bool have_classes(Grids grids) { return grids != Grids::kIndexes; }

// The two rules of docs/model.md section 3.
enum class FusionRule : std::uint8_t { kHitsWin, kBayes };

// A rectangle in subcells, both ends included.
struct Footprint {
  std::int32_t x_min = 0;
  std::int32_t x_max = 0;
  std::int32_t y_min = 0;
  std::int32_t y_max = 0;
};

struct Vehicle {
  std::string_view name;
  std::uint32_t id = 0;  // of all that follows and the name (car_block/content.hpp)
  std::span<const Sensor> sensors;
  Footprint footprint{};
  std::int32_t z_min = 0;  // the height band in subcells, both ends included
  std::int32_t z_max = 0;

  [[nodiscard]] constexpr HeightBand band() const { return {z_min, z_max}; }
  // The part of it in which beams of the sensor are low.
  [[nodiscard]] constexpr HeightBand low_band(const Sensor& sensor) const {
    return {z_min, sensor.moved.low_mm == MovedLimits::kAnyHeight
                       ? z_max
                       : std::min(z_max, subcells_of(sensor.moved.low_mm))};
  }

  FusionRule rule = FusionRule::kHitsWin;
  index::Quantisation quantisation = index::Quantisation::kBlurring;
  std::uint32_t frame_period_us = 0;
  Grids grids = Grids::kIndexes;
  bool has_objects = false;  // things with a speed on the grid of classes (docs/objects.md)
  pose::SourceDescription poses{};
  map::SourceDescription maps{};
  perception::Rules window{};

  // Whether its classes depend on when its packets arrive, because some sensor's clock is not that
  // of the poses.
  [[nodiscard]] constexpr bool depends_on_arrival() const {
    return have_classes(grids) && !std::ranges::all_of(sensors, &Sensor::is_synchronised);
  }
};

}  // namespace iog::vehicle
