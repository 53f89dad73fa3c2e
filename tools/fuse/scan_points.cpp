#include "tools/fuse/scan_points.hpp"

#include <cmath>

#include "intake/packet.hpp"
#include "tools/vehicles/packet_points.hpp"
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

ScanPoints::ScanPoints(const CatalogueEntry& car, OfflineTarget& target)
    : car_(&car), target_(&target), fusion_(std::make_unique<fusion::FrameFusion>(*car.vehicle)) {
  fusion_->follow(target.grounds());
}

std::vector<SeenPoint> ScanPoints::points_of(const CapturedDatagram& packet) {
  const std::size_t number = sensor_of_port(*car_, packet.destination.port);
  if (number == car_->sensors.size()) {
    return {};
  }
  const vehicle::Sensor& sensor = car_->vehicle->sensors[number];
  const intake::Packet decoded =
      intake::Packet::decode(sensor.format, packet.payload, sensor.unit());
  if (!decoded.is_sound()) {
    return {};
  }
  std::vector<vehicle::Fate> fates;
  const ListedPacket listed(decoded);
  fusion_->add_all(sensor, listed, [&](vehicle::Fate fate) { fates.push_back(fate); });
  fusion_->clear();
  std::vector<SeenPoint> points;
  const PointPlacer placer(car_->sensors[number]);
  auto fate = fates.begin();
  for (const lidar::ScanPoint& point : listed.points()) {
    if (point.range_mm != 0) {
      append(placer.place(point), *fate, points);
    }
    ++fate;
  }
  return points;
}

// The ground changes when a frame ends. The frame that a packet opens has the new one.
OfflineTarget::Closed ScanPoints::take(const CapturedDatagram& packet,
                                       std::vector<SeenPoint>& points) {
  std::vector<SeenPoint> its = points_of(packet);
  const OfflineTarget::Closed closed = target_->take(packet);
  if (closed.before > 0) {
    its = points_of(packet);
  }
  points.insert(points.end(), its.begin(), its.end());
  return closed;
}

}  // namespace iog::tools
