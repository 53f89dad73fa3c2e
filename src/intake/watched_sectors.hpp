// Determines the directions around the vehicle that no sensor watches.
//
// A turn around the vehicle's origin is divided into 64 sectors. Sector i extends from i / 64 to (i
// + 1) / 64 of a turn, counter-clockwise from straight ahead. Each sector has an arc on a circle
// with a radius of 20 m around the origin. A sensor watches a sector if the sector's arc is in
// range and the sensor has swept the azimuths of this arc. A sensor that does not spin must have
// swept seven eighths of these azimuths in the current frame. A spinning unit may sweep a sector in
// two frames, and a frame may be shorter than a turn. Such a unit therefore needs to sweep only
// half of the azimuths in one frame. The sector then counts as watched for 200 ms.
//
// Radars and ultrasonic sensors do not watch any sector because they do not report every object.
//
// A sensor does not watch any sector if its scan has no returns. A sensor does not watch a sector
// in which it is blocked (blocked_sectors.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "intake/blocked_sectors.hpp"
#include "intake/intake.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

// Returns the azimuth interval in which the sensor sees each sector.
[[nodiscard]] SectorView view_of(const vehicle::Sensor& sensor);

// Bit i of `unwatched` and `blocked` represents sector i.
struct Surroundings {
  std::uint64_t unwatched = 0;  // no sensor watches sector i
  std::uint64_t blocked = 0;    // a sensor that has looked into sector i is blocked there
  std::array<Blocked, vehicle::kMaxSensors> sensors{};
};

class WatchedSectors {
 public:
  // The slowest unit makes five revolutions per second.
  static constexpr std::uint64_t kTurnUs = 200'000;

  // The sensors must outlive this object.
  explicit WatchedSectors(std::span<const vehicle::Sensor> sensors);

  // This class is not copyable because it contains pointers to its own members.
  WatchedSectors(const WatchedSectors&) = delete;
  WatchedSectors& operator=(const WatchedSectors&) = delete;

  // Adds a packet of the current frame.
  void add(std::size_t sensor, const Packet& packet);

  // Returns the unwatched and blocked sectors at the end of the frame. `intake` must have received
  // the packets of this frame.
  [[nodiscard]] Surroundings at_end(const Intake& intake, std::uint64_t now_us);

  // Returns the silent azimuths of a packet of this sensor. The result also depends on earlier
  // frames.
  [[nodiscard]] AzimuthParts silent_azimuths(std::size_t sensor, const Packet& packet) const {
    return blocked_[sensor].silent_azimuths(packet);
  }

  // Ends the frame.
  void end_frame(const Intake& intake, std::uint64_t now_us);

 private:
  // Returns a mask in which bit i is set if the sensor has swept sector i in the current frame,
  // with or without returns.
  [[nodiscard]] std::uint64_t find_swept(std::size_t sensor, const Intake& intake) const;
  // Same as find_swept(), but the result is cached after the sensor's last packet.
  [[nodiscard]] std::uint64_t swept_by(std::size_t sensor, const Intake& intake) {
    std::optional<std::uint64_t>& swept = swept_[sensor];
    return swept ? *swept : swept.emplace(find_swept(sensor, intake));
  }

  std::span<const vehicle::Sensor> sensors_;
  std::array<SectorView, vehicle::kMaxSensors> views_{};
  std::array<BlockedSectors, vehicle::kMaxSensors> blocked_{};
  std::array<std::optional<std::uint64_t>, vehicle::kMaxSensors> swept_{};
  // `swept_us_` contains the time at which each sector was last swept. `was_swept_` contains the
  // sectors that have ever been swept. Both members are used only for spinning units.
  std::array<std::array<std::uint64_t, kSectors>, vehicle::kMaxSensors> swept_us_{};
  std::array<std::uint64_t, vehicle::kMaxSensors> was_swept_{};
};

}  // namespace iog::intake
