// Which directions around the vehicle no sensor watches: what a planner asks first.
//
// A turn around the vehicle's origin is cut into 64 sectors: sector i goes from i / 64 to
// (i + 1) / 64 of a turn, counter-clockwise from straight ahead. A sensor watches one if it has
// swept the azimuths between which it sees the sector's part of a circle of 20 m around the origin,
// and reaches that far. Of a sensor that does not turn that is seven eighths of them in the frame
// at hand. A unit that turns may sweep a sector in two frames, and a frame may be shorter than its
// turn: of it half of them in one frame are enough, for 200 ms.
//
// A radar and an ultrasonic unit watch nothing: where they report nothing, there may be something.
//
// A whole scan without a single point is that of a sensor that is blind, and watches nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "intake/intake.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

inline constexpr std::size_t kSectors = 64;

// The azimuths of a sensor between which it sees a sector; of width 0 if it does not reach it.
using SectorView = std::array<lidar::Sector, kSectors>;
[[nodiscard]] SectorView view_of(const vehicle::Sensor& sensor);

class WatchedSectors {
 public:
  // The slowest unit turns five times a second.
  static constexpr std::uint64_t kTurnUs = 200'000;

  // sensors outlive it.
  explicit WatchedSectors(std::span<const vehicle::Sensor> sensors);

  // Bit i: no sensor watches sector i at the end of the frame that the intake has taken in.
  [[nodiscard]] std::uint64_t unwatched(const Intake& intake, std::uint64_t now_us) const;

  // The frame is closed.
  void end_frame(const Intake& intake, std::uint64_t now_us);

 private:
  // Bit i: the sensor has swept sector i in the frame at hand.
  [[nodiscard]] std::uint64_t swept_by(std::size_t sensor, const Intake& intake) const;

  std::span<const vehicle::Sensor> sensors_;
  std::array<SectorView, vehicle::kMaxSensors> views_{};
  // Of units that turn, when each sector was swept last, and whether it ever was.
  std::array<std::array<std::uint64_t, kSectors>, vehicle::kMaxSensors> swept_us_{};
  std::array<std::uint64_t, vehicle::kMaxSensors> was_swept_{};
};

}  // namespace iog::intake
