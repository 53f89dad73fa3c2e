#include "tools/fuse/scan_points.hpp"

#include <cmath>

#include "intake/packet.hpp"
#include "tools/vehicles/point_place.hpp"

namespace iog::tools {
namespace {

constexpr double kReachM = 300;  // 16 bits of centimetres hold it

void append(const PointPlace& place, vehicle::Fate fate, std::vector<SeenPoint>& points) {
  const auto is_near = [](double value_m) { return std::abs(value_m) <= kReachM; };
  if (is_near(place.x_m) && is_near(place.y_m) && is_near(place.z_m)) {
    points.push_back({.x_cm = static_cast<std::int16_t>(std::lround(place.x_m * 100)),
                      .y_cm = static_cast<std::int16_t>(std::lround(place.y_m * 100)),
                      .z_cm = static_cast<std::int16_t>(std::lround(place.z_m * 100)),
                      .fate = fate});
  }
}

}  // namespace

void append_points(const CatalogueEntry& car, const CapturedDatagram& packet,
                   std::vector<SeenPoint>& points) {
  const std::size_t number = sensor_of_port(car, packet.destination.port);
  if (number == car.sensors.size()) {
    return;
  }
  const vehicle::Sensor& sensor = car.vehicle->sensors[number];
  const intake::Packet decoded =
      intake::Packet::decode(sensor.format, packet.payload, sensor.unit());
  if (!decoded.is_sound()) {
    return;
  }
  const PointPlacer placer(car.sensors[number]);
  decoded.for_each_point([&](const lidar::ScanPoint& point) {
    if (point.range_mm != 0) {
      const vehicle::Beam beam = vehicle::aim(sensor, point.layer, point.azimuth_ticks);
      append(placer.place(point), vehicle::classify(sensor, beam, point).fate, points);
    }
  });
}

}  // namespace iog::tools
