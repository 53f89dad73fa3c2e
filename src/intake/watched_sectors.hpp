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

// Where the sensor sees each sector.
[[nodiscard]] SectorView view_of(const vehicle::Sensor& sensor);

// Bit i is of sector i.
struct Surroundings {
  std::uint64_t unwatched = 0;  // no sensor watches it
  std::uint64_t blocked = 0;    // some sensor that has looked into it is blocked there
  std::array<Blocked, vehicle::kMaxSensors> sensors{};
};

class WatchedSectors {
 public:
  // The slowest unit turns five times a second.
  static constexpr std::uint64_t kTurnUs = 200'000;

  // sensors outlive it.
  explicit WatchedSectors(std::span<const vehicle::Sensor> sensors);

  // It outlives what it points to.
  WatchedSectors(const WatchedSectors&) = delete;
  WatchedSectors& operator=(const WatchedSectors&) = delete;

  // The packet is part of the frame at hand.
  void add(std::size_t sensor, const Packet& packet);

  // At the end of the frame that the intake has taken in.
  [[nodiscard]] Surroundings at_end(const Intake& intake, std::uint64_t now_us) const;

  // Of that sensor's packet, by the frames before.
  [[nodiscard]] AzimuthParts silent_azimuths(std::size_t sensor, const Packet& packet) const {
    return blocked_[sensor].silent_azimuths(packet);
  }

  // The frame is closed.
  void end_frame(const Intake& intake, std::uint64_t now_us);

 private:
  // Bit i: the sensor has swept sector i in the frame at hand, with or without returns.
  [[nodiscard]] std::uint64_t swept_by(std::size_t sensor, const Intake& intake) const;

  std::span<const vehicle::Sensor> sensors_;
  std::array<SectorView, vehicle::kMaxSensors> views_{};
  std::array<BlockedSectors, vehicle::kMaxSensors> blocked_{};
  // Of units that turn, when each sector was swept last, and whether it ever was.
  std::array<std::array<std::uint64_t, kSectors>, vehicle::kMaxSensors> swept_us_{};
  std::array<std::uint64_t, vehicle::kMaxSensors> was_swept_{};
};

}  // namespace iog::intake
