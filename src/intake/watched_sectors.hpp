// The directions around the vehicle that no sensor watches, which a planner needs first.
//
// A turn around the vehicle's origin is cut into 64 sectors: sector i goes from i / 64 to (i + 1) /
// 64 of a turn, counter-clockwise from straight ahead. Each sector has an arc on a circle of 20 m
// around the origin. A sensor watches a sector if it reaches this arc and has swept the azimuths
// between which it sees the arc. For a sensor that does not spin, seven eighths of these azimuths
// must be swept in the current frame. A spinning unit may sweep a sector in two frames, and a frame
// may be shorter than its turn. So half of the azimuths in one frame are enough, and count for 200
// ms.
//
// Radars and ultrasonic units watch nothing, because there may be objects that they do not report.
//
// A sensor watches nothing in a scan without any return, nor in a sector in which it is blocked
// (blocked_sectors.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "intake/blocked_sectors.hpp"
#include "intake/intake.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

// The azimuths between which the sensor sees each sector.
[[nodiscard]] SectorView view_of(const vehicle::Sensor& sensor);

// Bit i is for sector i.
struct Surroundings {
  std::uint64_t unwatched = 0;  // no sensor watches it
  std::uint64_t blocked = 0;    // a sensor that has looked into it is blocked there
  std::array<Blocked, vehicle::kMaxSensors> sensors{};
};

class WatchedSectors {
 public:
  // The slowest unit turns five times per second.
  static constexpr std::uint64_t kTurnUs = 200'000;

  // sensors must outlive it.
  explicit WatchedSectors(std::span<const vehicle::Sensor> sensors);

  // Not copyable, because it holds pointers into itself.
  WatchedSectors(const WatchedSectors&) = delete;
  WatchedSectors& operator=(const WatchedSectors&) = delete;

  // Adds a packet of the current frame.
  void add(std::size_t sensor, const Packet& packet);

  // The surroundings at the end of the frame that `intake` has received.
  [[nodiscard]] Surroundings at_end(const Intake& intake, std::uint64_t now_us) const;

  // The silent azimuths of a packet of that sensor, judged by earlier frames.
  [[nodiscard]] AzimuthParts silent_azimuths(std::size_t sensor, const Packet& packet) const {
    return blocked_[sensor].silent_azimuths(packet);
  }

  // Closes the frame.
  void end_frame(const Intake& intake, std::uint64_t now_us);

 private:
  // Bit i: the sensor has swept sector i in the current frame, with or without returns.
  [[nodiscard]] std::uint64_t swept_by(std::size_t sensor, const Intake& intake) const;

  std::span<const vehicle::Sensor> sensors_;
  std::array<SectorView, vehicle::kMaxSensors> views_{};
  std::array<BlockedSectors, vehicle::kMaxSensors> blocked_{};
  // For spinning units: when each sector was last swept, and whether it ever was.
  std::array<std::array<std::uint64_t, kSectors>, vehicle::kMaxSensors> swept_us_{};
  std::array<std::uint64_t, vehicle::kMaxSensors> was_swept_{};
};

}  // namespace iog::intake
