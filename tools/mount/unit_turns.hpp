// What each turn of a unit says of its mount.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/car/description.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/mount/ground_plane.hpp"
#include "tools/mount/turn_cutter.hpp"
#include "tools/vehicles/point_place.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// Angles and height as description::MountConfig has them, with the yaw of the car's file. The roll
// is within half a turn of the file's.
struct TurnMount {
  std::uint64_t time_us = 0;  // of the turn's last packet
  double pitch_deg = 0;
  double roll_deg = 0;
  double z_m = 0;
  double residual_m = 0;
};

// The mount with which the unit's ground would be the car's plane.
[[nodiscard]] TurnMount mount_of(const GroundPlane& plane, const description::MountConfig& by_file);

class UnitTurns {
 public:
  // sensor: of a unit that turns. car outlives this. Of each `every` turns, the first is looked at.
  UnitTurns(const CatalogueEntry& car, std::size_t sensor, std::uint64_t every = 1);

  // The next datagram of the capture; what is not for the unit is left alone.
  void take(const CapturedDatagram& datagram);
  // The capture is over. A turn that it cuts short by more than a quarter is left out.
  void finish();

  [[nodiscard]] std::uint64_t packets() const { return packets_; }
  [[nodiscard]] std::uint64_t turns() const { return turns_; }
  // Of the turns that show the ground, in their order.
  [[nodiscard]] const std::vector<TurnMount>& mounts() const { return mounts_; }
  // Whether nearly all turns show it only if the unit is the other way up than the file says.
  [[nodiscard]] bool is_other_way_up() const;

 private:
  void end_turn();
  void keep(const PointPlace& place);

  const vehicle::Sensor* sensor_;
  std::uint64_t every_;
  description::MountConfig mount_;
  description::FootprintConfig footprint_;
  PointPlacer placer_;
  TurnCutter cutter_;
  std::vector<RoadReturn> returns_;  // of the turn that has begun
  std::uint64_t last_us_ = 0;
  std::uint64_t packets_ = 0;
  std::uint64_t turns_ = 0;
  std::vector<TurnMount> mounts_;
  std::uint64_t turned_over_ = 0;  // turns that show the ground only the other way up
};

}  // namespace iog::tools
