#include "tools/vehicles/point_place.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "lidar/formats.hpp"
#include "lidar/scanner_facts.hpp"
#include "tools/car/tilted_mirror.hpp"

namespace iog::tools {

PointPlacer::PointPlacer(const description::SensorConfig& sensor)
    : mount_(sensor.mount),
      turn_(description::rotation_of(sensor.mount)),
      tilt_rad_(description::radians(sensor.beam_tilt_deg)) {
  lidar::with_decoder(sensor.format, [&]<typename Decoder>(std::type_identity<Decoder>) {
    radians_per_tick_ = 2 * std::numbers::pi / Decoder::kTicksPerTurn;
    for (const lidar::Laser& laser : sensor.lasers) {
      const double elevation = description::radians(laser.elevation_deg);
      layers_.push_back(
          {.elevation_rad = elevation, .height_m = laser.height_m / std::cos(elevation)});
    }
    for (std::size_t i = layers_.size(); i < Decoder::kElevationsDeg.size(); ++i) {
      Layer& layer = layers_.emplace_back();
      layer.elevation_rad = description::radians(Decoder::kElevationsDeg[i]);
      if constexpr (lidar::HasBeamTilt<Decoder>) {
        layer.looks_up = Decoder::looks_up(i);
      }
    }
  });
}

double PointPlacer::elevation_rad(const Layer& layer, double azimuth_rad) const {
  return tilt_rad_ == 0
             ? layer.elevation_rad
             : description::tilted_elevation(layer.elevation_rad, layer.looks_up, tilt_rad_,
                                             std::remainder(azimuth_rad, 2 * std::numbers::pi));
}

PointPlace PointPlacer::place(const lidar::ScanPoint& point) const {
  const Layer& layer = layers_[point.layer];
  const double azimuth = point.azimuth_ticks * radians_per_tick_;
  const double elevation = elevation_rad(layer, azimuth);
  const double range_m = point.range_mm / 1000.0;
  const double forward = range_m * std::cos(elevation) * std::cos(azimuth);
  const double left = range_m * std::cos(elevation) * std::sin(azimuth);
  const double up = range_m * std::sin(elevation) + layer.height_m;
  const auto along = [&](double origin_m, std::size_t axis) {
    return origin_m + forward * turn_.forward[axis] + left * turn_.left[axis] + up * turn_.up[axis];
  };
  return {.x_m = along(mount_.x_m, 0), .y_m = along(mount_.y_m, 1), .z_m = along(mount_.z_m, 2)};
}

}  // namespace iog::tools
