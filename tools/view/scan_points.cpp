#include "tools/view/scan_points.hpp"

#include <cmath>
#include <numbers>

#include "description/mount.hpp"
#include "description/tilted_mirror.hpp"
#include "intake/packet.hpp"
#include "lidar/scanner_facts.hpp"

namespace iog::tools::view {
namespace {

constexpr double kReachM = 300;  // 16 bits of centimetres hold it

class Placer {
 public:
  Placer(const CatalogueEntry& car, std::size_t sensor, std::vector<SeenPoint>& points)
      : sensor_(&car.vehicle->sensors[sensor]),
        mount_(car.sensors[sensor].mount),
        lasers_(car.sensors[sensor].lasers),
        tilt_rad_(description::radians(car.sensors[sensor].beam_tilt_deg)),
        turn_(description::rotation_of(mount_)),
        points_(&points) {}

  void append(std::span<const std::byte> payload) {
    const intake::Packet packet = intake::Packet::decode(sensor_->format, payload, sensor_->unit());
    lidar::with_decoder(sensor_->format, [&]<typename Decoder>(std::type_identity<Decoder>) {
      packet.for_each_point([&](const lidar::ScanPoint& point) {
        const double elevation_deg = lasers_.empty() ? Decoder::kElevationsDeg.at(point.layer)
                                                     : lasers_[point.layer].elevation_deg;
        const double azimuth_rad =
            point.azimuth_ticks * (2 * std::numbers::pi / Decoder::kTicksPerTurn);
        double elevation_rad = elevation_deg * std::numbers::pi / 180;
        if constexpr (lidar::HasBeamTilt<Decoder>) {
          elevation_rad = description::tilted_elevation(
              elevation_rad, Decoder::looks_up(point.layer), tilt_rad_,
              std::remainder(azimuth_rad, 2 * std::numbers::pi));
        }
        if (point.range_mm != 0) {
          place(point, azimuth_rad, elevation_rad);
        }
      });
    });
  }

 private:
  void place(const lidar::ScanPoint& point, double azimuth_rad, double elevation_rad) {
    const double range_m = point.range_mm / 1000.0;
    const double forward = range_m * std::cos(elevation_rad) * std::cos(azimuth_rad);
    const double left = range_m * std::cos(elevation_rad) * std::sin(azimuth_rad);
    const double up = range_m * std::sin(elevation_rad);
    const auto along = [&](double origin_m, std::size_t axis) {
      return origin_m + forward * turn_.forward[axis] + left * turn_.left[axis] +
             up * turn_.up[axis];
    };
    const double x_m = along(mount_.x_m, 0);
    const double y_m = along(mount_.y_m, 1);
    if (std::abs(x_m) > kReachM || std::abs(y_m) > kReachM) {
      return;
    }
    const vehicle::Beam beam = vehicle::aim(*sensor_, point.layer, point.azimuth_ticks);
    points_->push_back({.x_cm = static_cast<std::int16_t>(std::lround(x_m * 100)),
                        .y_cm = static_cast<std::int16_t>(std::lround(y_m * 100)),
                        .fate = vehicle::classify(*sensor_, beam, point).fate});
  }

  const vehicle::Sensor* sensor_;
  description::MountConfig mount_;
  std::span<const lidar::Laser> lasers_;
  double tilt_rad_;
  description::Rotation turn_;
  std::vector<SeenPoint>* points_;
};

}  // namespace

void append_points(const CatalogueEntry& car, const CapturedDatagram& packet,
                   std::vector<SeenPoint>& points) {
  const std::size_t sensor = sensor_of_port(car, packet.destination.port);
  if (sensor == car.sensors.size()) {
    return;
  }
  Placer(car, sensor, points).append(packet.payload);
}

}  // namespace iog::tools::view
