// Beams of a tilted mirror against SICK's own driver (libsick_ldmrs, LuxBase::getVAngleOfLayer),
// written here in its terms: a vertical angle is a pitch, positive down.
#include "tools/car/tilted_mirror.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>

#include "geometry/grid.hpp"
#include "tools/car/scanners.hpp"
#include "tools/car/tables.hpp"
#include "vehicle/beam.hpp"

namespace iog::description {
namespace {

const double kDegree = std::acos(-1.0) / 180;

// layer: 0 to 3 of that side.
double pitch_of(bool is_rear, int layer, double beam_tilt, double horizontal) {
  const double mirror_tilt =
      beam_tilt / 2 * std::sqrt(2.0) * std::sin(0.5 * horizontal - std::atan(1.0));
  const double direction = is_rear ? 1.0 : -1.0;
  const double offset = (3.0 / 2 - layer) * 0.8 * kDegree;
  return offset + direction * 2 * mirror_tilt;
}

// Eight layers of 0.8 degrees lie evenly if the tilt is 1.6 degrees; 0.48 and 1.33 of it at the
// edges.
TEST(TiltedMirror, LayersAreEvenAheadAndNotAtTheEdges) {
  const auto elevation = [](double layer_deg, bool looks_up, double azimuth_deg) {
    return tilted_elevation(layer_deg * kDegree, looks_up, 1.6 * kDegree, azimuth_deg * kDegree) /
           kDegree;
  };
  EXPECT_NEAR(elevation(-1.2, false, 0), -2.8, 1e-9);
  EXPECT_NEAR(elevation(1.2, false, 0), -0.4, 1e-9);
  EXPECT_NEAR(elevation(-1.2, true, 0), 0.4, 1e-9);
  EXPECT_NEAR(elevation(1.2, true, 0), 2.8, 1e-9);
  EXPECT_NEAR(elevation(0, false, 50), -1.6 * 0.484, 0.001);
  EXPECT_NEAR(elevation(0, true, 50), 1.6 * 0.484, 0.001);
  EXPECT_NEAR(elevation(0, true, -50), 1.6 * 1.329, 0.001);
}

constexpr Description kCar{
    .name = "tilted", .footprint = {-2, 2, -1, 1}, .z_min_m = 0.2, .z_max_m = 2.2};

SensorConfig unit_with(double beam_tilt_deg) {
  SensorConfig config = scanner_of(lidar::kFormat<lidar::IbeoLux8>);
  config.mount = {.x_m = 1, .y_m = 0.3, .z_m = 1.6, .yaw_deg = 40, .pitch_deg = 2, .roll_deg = -3};
  config.beam_tilt_deg = beam_tilt_deg;
  return config;
}

using Vector = std::array<double, 3>;

Vector about(std::size_t axis, const Vector& v, double angle) {
  const std::size_t from = (axis + 1) % 3;
  const std::size_t to = (axis + 2) % 3;
  Vector turned = v;
  turned[from] = v[from] * std::cos(angle) - v[to] * std::sin(angle);
  turned[to] = v[from] * std::sin(angle) + v[to] * std::cos(angle);
  return turned;
}

// By one rotation after the other: roll first, yaw last.
Vector end_of(const MountConfig& mount, double azimuth, double elevation, double length_m) {
  Vector v{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
           std::sin(elevation)};
  v = about(0, v, mount.roll_deg * kDegree);
  v = about(1, v, mount.pitch_deg * kDegree);
  v = about(2, v, mount.yaw_deg * kDegree);
  return {mount.x_m + length_m * v[0], mount.y_m + length_m * v[1], mount.z_m + length_m * v[2]};
}

// How far the ends of beams are off at most, in metres.
double worst_end_m(double beam_tilt_deg) {
  const SensorConfig config = unit_with(beam_tilt_deg);
  const vehicle::Sensor sensor = sensor_of(config, kCar);
  double worst = 0;
  for (std::uint8_t layer = 0; layer < 8; ++layer) {
    for (int tick = -1920; tick <= 1600; ++tick) {
      const double azimuth = tick * kDegree / 32;
      const double elevation = -pitch_of(layer >= 4, layer % 4, beam_tilt_deg * kDegree, azimuth);
      const Vector end = end_of(config.mount, azimuth, elevation, 50);
      const vehicle::Beam beam =
          vehicle::aim(sensor, layer, static_cast<std::uint16_t>((tick + 11520) % 11520));
      const auto& x = beam.line.x();
      const auto& y = beam.line.y();
      const double scale = geometry::kSubcellsPerMetre;
      const double dx =
          (sensor.origin.x + x.step() * static_cast<double>(x.length())) / scale - 51.2 - end[0];
      const double dy =
          (sensor.origin.y + y.step() * static_cast<double>(y.length())) / scale - 51.2 - end[1];
      const double dz = beam.end_z / scale - end[2];
      worst = std::max(worst, std::sqrt(dx * dx + dy * dy + dz * dz));
    }
  }
  return worst;
}

// The fit is off by less than a thousandth of the range, 50 m; of what a mirror without its tilt
// would be off by, 1.4 m and more, that is little.
TEST(TiltedMirror, BeamsEndWhereTheDriverSays) {
  EXPECT_LT(worst_end_m(0.2), 0.01);
  EXPECT_LT(worst_end_m(1.6), 0.03);
  EXPECT_LT(worst_end_m(2.0), 0.04);
}

// The height takes nearly all of what is off.
TEST(TiltedMirror, ThePlaceInThePlanIsRightToAMillimetreInTenMetres) {
  const double tilt = 2 * kDegree;
  for (const bool is_rear : {false, true}) {
    for (int layer = 0; layer < 4; ++layer) {
      const FittedDirections fit = fit_directions(-60 * kDegree, 50 * kDegree, [&](double azimuth) {
        return -pitch_of(is_rear, layer, tilt, azimuth);
      });
      for (int tick = -1920; tick <= 1600; ++tick) {
        const double azimuth = tick * kDegree / 32;
        const double elevation = -pitch_of(is_rear, layer, tilt, azimuth);
        const auto at = [&](std::size_t axis) {
          return fit.base[axis] + fit.forward[axis] * std::cos(azimuth) +
                 fit.left[axis] * std::sin(azimuth);
        };
        ASSERT_LT(std::hypot(at(0) - std::cos(elevation) * std::cos(azimuth),
                             at(1) - std::cos(elevation) * std::sin(azimuth)),
                  0.0001);
        ASSERT_NEAR(at(2), std::sin(elevation), 0.001);
      }
    }
  }
}

}  // namespace
}  // namespace iog::description
