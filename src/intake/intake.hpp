// Converts datagrams to packets and assigns them to frames.
//
// A datagram is decoded only once. After closing a frame, the caller can therefore classify the
// same packet again for the next frame. Dropped datagrams are counted by cause.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "health/constants.hpp"
#include "intake/datagram.hpp"
#include "intake/measured_ranges.hpp"
#include "intake/packet.hpp"
#include "intake/scan_tracker.hpp"
#include "intake/sensor_report.hpp"
#include "lidar/velodyne_identity.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::intake {

// A valid packet, the index of its sensor in Vehicle::sensors, and the bytes from which it was
// decoded.
struct SensorPacket {
  std::size_t sensor = 0;
  Packet packet;
  std::span<const std::byte> payload{};
  std::uint64_t range_digest = RangeDigest::kNone;
};

class Intake {
 public:
  enum class Outcome : std::uint8_t {
    kDropped,    // dropped and counted; nothing else to do
    kThisFrame,  // fuse it, then call accept()
    kNextFrame,  // close the frame, then call classify() again
  };

  // `sensors` must outlive the intake. The replayer at `replayer_ipv4` may send on behalf of any
  // sensor. The address is 0 if there is no replayer.
  Intake(std::span<const vehicle::Sensor> sensors, std::uint32_t replayer_ipv4);

  // Returns true if the datagram was sent to a sensor's port by a source that may send on behalf of
  // this sensor.
  [[nodiscard]] bool listens_to(const Datagram& datagram) const {
    return sensor_of(datagram) != kNobody;
  }

  // Finds the sensor of a datagram, and decodes the datagram. Returns std::nullopt if the datagram
  // was dropped. The payload must outlive the result.
  [[nodiscard]] std::optional<SensorPacket> receive(const Datagram& datagram);

  // Determines whether the packet belongs to the open frame. Drops the packet if it must not be
  // fused, for example because it is late or a duplicate.
  [[nodiscard]] Outcome classify(const SensorPacket& packet);

  // Adds the packet to the open frame. Call this function only after classify() has returned
  // kThisFrame.
  void accept(const SensorPacket& packet);
  // Drops the packet because the target is too slow. The packet may belong to any frame.
  void leave(const SensorPacket& packet);

  // Returns true if every sensor has delivered its scan.
  [[nodiscard]] bool is_complete() const;

  // Ends the frame and starts the next one.
  void start_frame();

  // Returns the report of a sensor for the current frame.
  [[nodiscard]] SensorReport report_of(std::size_t sensor) const;
  [[nodiscard]] std::uint32_t swept_ticks(std::size_t sensor) const {
    return trackers_[sensor].swept_ticks();
  }
  // Returns true if the sensor has left more than `ticks` ticks of the sector unswept in this
  // frame.
  [[nodiscard]] bool misses_more_than(std::uint32_t ticks, std::size_t sensor,
                                      const lidar::Sector& sector) const {
    return trackers_[sensor].misses_more_than(ticks, sector);
  }
  [[nodiscard]] std::uint32_t packets_accepted() const { return packets_accepted_; }
  [[nodiscard]] std::uint32_t points_dropped(vehicle::Fate fate) const {
    return points_dropped_[static_cast<std::size_t>(fate)];
  }

  // Returns the number of dropped datagrams since start, by cause.
  [[nodiscard]] const std::array<std::uint32_t, kPacketDropCount>& packet_drops() const {
    return packet_drops_;
  }
  [[nodiscard]] std::uint32_t packets_dropped() const { return packets_dropped_; }

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, sensors_, replayer_ipv4_);
  }

 private:
  // Returns the sensor that may send from this source to this port, or kNobody if there is none.
  [[nodiscard]] std::size_t sensor_of(const Datagram& datagram) const;
  [[nodiscard]] bool is_of_unit(std::size_t sensor, const Packet& packet);
  void drop(PacketDrop cause);
  void drop(PacketDrop cause, vehicle::Fate fate, const Packet& packet);

  static constexpr std::size_t kNobody = vehicle::kMaxSensors;

  std::span<const vehicle::Sensor> sensors_;
  std::uint32_t replayer_ipv4_;
  std::array<ScanTracker, vehicle::kMaxSensors> trackers_;
  std::array<lidar::VelodyneIdentity, vehicle::kMaxSensors> identities_;
  std::array<RangeDigest, vehicle::kMaxSensors> digests_;
  std::array<FrozenWatch, vehicle::kMaxSensors> frozen_;
  std::uint32_t packets_accepted_ = 0;
  std::array<std::uint32_t, vehicle::kFateCount> points_dropped_{};
  std::array<std::uint32_t, kPacketDropCount> packet_drops_{};
  std::uint32_t packets_dropped_ = 0;
};

}  // namespace iog::intake
