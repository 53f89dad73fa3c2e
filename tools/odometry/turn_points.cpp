#include "tools/odometry/turn_points.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "intake/packet.hpp"
#include "lidar/formats.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/vehicles/packet_points.hpp"

namespace iog::tools {
namespace {

// Nearer returns are of the car and of dust. Farther ones are too sparse for a plane.
constexpr std::uint32_t kNearestMm = 1'000;
constexpr std::uint32_t kFarthestMm = 100'000;

}  // namespace

TurnPoints::TurnPoints(const CatalogueEntry& car) : car_(&car) {
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    if (lidar::turns(car.sensors[i].format)) {
      units_.push_back(
          {car.sensors[i].name, &car.vehicle->sensors[i], PointPlacer(car.sensors[i])});
    }
  }
  if (units_.empty()) {
    throw UsageError(std::string(car.vehicle->name) +
                     " has no spinning lidar, and the motion is estimated from its turns");
  }
  cutter_.emplace(units_.front().sensor->format);
}

std::optional<Turn> TurnPoints::take(const CapturedDatagram& datagram) {
  std::optional<Turn> whole;
  for (const Unit& unit : units_) {
    if (datagram.destination.port != unit.sensor->udp_port) {
      continue;
    }
    const intake::Packet packet =
        intake::Packet::decode(unit.sensor->format, datagram.payload, unit.sensor->unit());
    if (!packet.is_sound()) {
      continue;
    }
    if (&unit == &units_.front()) {
      pace_.add(packet.info().sweep.begin_us, datagram.time_us);
      if (cutter_->ends_before(packet.info())) {
        whole = std::move(turn_);
        turn_ = {};
      }
    }
    turn_.end_us = std::max(turn_.end_us, datagram.time_us);
    for (const lidar::ScanPoint& point : points_of(packet)) {
      keep(datagram, unit, point);
    }
  }
  return whole;
}

void TurnPoints::keep(const CapturedDatagram& datagram, const Unit& unit,
                      const lidar::ScanPoint& point) {
  if (point.range_mm < kNearestMm || point.range_mm > kFarthestMm || point.is_dirt ||
      point.is_rain) {
    return;
  }
  const PointPlace place = unit.placer.place(point);
  const description::FootprintConfig& car = car_->description->footprint;
  const bool is_on_car = place.x_m >= car.x_min_m && place.x_m <= car.x_max_m &&
                         place.y_m >= car.y_min_m && place.y_m <= car.y_max_m;
  if (!is_on_car) {
    turn_.points.push_back({{place.x_m, place.y_m, place.z_m}, datagram.time_us});
  }
}

}  // namespace iog::tools
