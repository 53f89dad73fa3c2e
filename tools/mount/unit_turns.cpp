#include "tools/mount/unit_turns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "intake/packet.hpp"
#include "lidar/formats.hpp"
#include "tools/car/mount.hpp"
#include "tools/vehicles/packet_points.hpp"

namespace iog::tools {
namespace {

// To either side of the car's middle: the lane that its wheels are on. Roads fall to both sides of
// their middle, by 2 % or so, and who takes the other lane for a part of the same plane finds a
// roll that is 1 degree wrong, in every part of a recording alike.
constexpr double kLaneHalfWidthM = 2;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kTurnDeg = 360;

// Fewer turns may be wrong.
constexpr std::uint64_t kFewestTurnedOver = 10;

// By half a turn about the unit's x.
std::vector<RoadReturn> turned_over(std::vector<RoadReturn> returns,
                                    const description::Rotation& turn) {
  const std::array<double, 3>& x = turn.forward;
  for (RoadReturn& point : returns) {
    const double along = 2 * (point.x_m * x[0] + point.y_m * x[1] + point.z_m * x[2]);
    point = {along * x[0] - point.x_m, along * x[1] - point.y_m, along * x[2] - point.z_m};
  }
  return returns;
}

}  // namespace

// The ground's normal, turned back into the sensor frame by the file's mount, is the lowest row of
// the true one: -sin pitch, cos pitch sin roll, cos pitch cos roll.
TurnMount mount_of(const GroundPlane& plane, const description::MountConfig& by_file) {
  const description::Rotation turn = description::rotation_of(by_file);
  const double length = std::sqrt(1 + plane.along * plane.along + plane.across * plane.across);
  const auto upward = [&](const std::array<double, 3>& axis) {
    return (axis[2] - plane.along * axis[0] - plane.across * axis[1]) / length;
  };
  const double roll_deg = std::atan2(upward(turn.left), upward(turn.up)) * kDegrees;
  return {.pitch_deg = std::asin(-upward(turn.forward)) * kDegrees,
          .roll_deg = by_file.roll_deg + std::remainder(roll_deg - by_file.roll_deg, kTurnDeg),
          .z_m = plane.below_m / length,
          .residual_m = plane.residual_m};
}

UnitTurns::UnitTurns(const CatalogueEntry& car, std::size_t sensor, std::uint64_t every)
    : sensor_(&car.vehicle->sensors[sensor]),
      every_(every),
      mount_(car.sensors[sensor].mount),
      footprint_(car.description->footprint),
      placer_(car.sensors[sensor]),
      cutter_(sensor_->format) {}

void UnitTurns::take(const CapturedDatagram& datagram) {
  if (datagram.destination.port != sensor_->udp_port) {
    return;
  }
  const intake::Packet packet =
      intake::Packet::decode(sensor_->format, datagram.payload, sensor_->unit());
  if (!packet.is_sound()) {
    return;
  }
  ++packets_;
  if (cutter_.ends_before(packet.info())) {
    end_turn();
  }
  last_us_ = datagram.time_us;
  if (turns_ % every_ != 0) {
    return;
  }
  for (const lidar::ScanPoint& point : points_of(packet)) {
    if (point.range_mm >= sensor_->range_min_mm && point.range_mm > 0) {
      keep(placer_.place(point));
    }
  }
}

void UnitTurns::keep(const PointPlace& place) {
  const RoadReturn point{
      .x_m = place.x_m - mount_.x_m, .y_m = place.y_m - mount_.y_m, .z_m = place.z_m - mount_.z_m};
  const double out_m = std::hypot(point.x_m, point.y_m);
  const bool is_on_car = place.x_m >= footprint_.x_min_m && place.x_m <= footprint_.x_max_m &&
                         place.y_m >= footprint_.y_min_m && place.y_m <= footprint_.y_max_m;
  if (out_m >= kNearestRoadM && out_m < kFarthestRoadM && std::abs(place.y_m) < kLaneHalfWidthM &&
      !is_on_car) {
    returns_.push_back(point);
  }
}

void UnitTurns::end_turn() {
  ++turns_;
  if (const std::optional<GroundPlane> plane = ground_plane_of(returns_, mount_.z_m)) {
    mounts_.push_back(mount_of(*plane, mount_));
    mounts_.back().time_us = last_us_;
  } else if (ground_plane_of(
                 tools::turned_over(std::move(returns_), description::rotation_of(mount_)),
                 mount_.z_m)) {
    ++turned_over_;
  }
  returns_.clear();
}

// The ground is above a unit whose file has it the wrong way up.
bool UnitTurns::is_other_way_up() const {
  const auto above = static_cast<std::uint64_t>(
      std::ranges::count_if(mounts_, [](const TurnMount& turn) { return turn.z_m < 0; }));
  return turned_over_ + above >= std::max(kFewestTurnedOver, 5 * (mounts_.size() - above));
}

void UnitTurns::finish() {
  if (cutter_.is_nearly_whole()) {
    end_turn();
  }
}

}  // namespace iog::tools
