// The points of each turn of a car's lidars, in the vehicle frame, with their times.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/formats/capture/clock_pace.hpp"
#include "tools/formats/capture/datagram.hpp"
#include "tools/mount/turn_cutter.hpp"
#include "tools/vehicles/point_place.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

struct TimedPoint {
  Eigen::Vector3d place;  // in the vehicle frame at time_us
  std::uint64_t time_us;
};

struct Turn {
  std::uint64_t end_us = 0;  // of its last packet; no point is newer
  std::vector<TimedPoint> points{};
};

class TurnPoints {
 public:
  // Turns are those of the car's first spinning lidar. UsageError if the car has none. The car
  // outlives this.
  explicit TurnPoints(const CatalogueEntry& car);

  // The next datagram of the capture. Returns a turn that ended before it. The last turn of a
  // capture is left out.
  [[nodiscard]] std::optional<Turn> take(const CapturedDatagram& datagram);

  // As of ClockPace, of the first unit.
  [[nodiscard]] std::string words_of_pace() const {
    return pace_.words(std::string(units_.front().name));
  }

 private:
  struct Unit {
    std::string_view name;
    const vehicle::Sensor* sensor;
    PointPlacer placer;
  };

  void keep(const CapturedDatagram& datagram, const Unit& unit, const lidar::ScanPoint& point);

  const CatalogueEntry* car_;
  std::vector<Unit> units_;
  std::optional<TurnCutter> cutter_;  // of the first unit
  ClockPace pace_;
  Turn turn_;
};

}  // namespace iog::tools
