#include "intake/intake.hpp"

#include <algorithm>

#include "lidar/scanner_facts.hpp"
#include "protection/believed.hpp"
#include "require/require.hpp"

namespace iog::intake {
namespace {

// PacketDrop has a cause for every kind of decoding failure.
PacketDrop cause_of(lidar::DecodeStatus status) {
  switch (status) {
    case lidar::DecodeStatus::kWrongLength:
      return PacketDrop::kWrongLength;
    case lidar::DecodeStatus::kWrongType:
      return PacketDrop::kWrongType;
    case lidar::DecodeStatus::kWrongAngle:
      return PacketDrop::kWrongAngle;
    case lidar::DecodeStatus::kOtherUnit:
      return PacketDrop::kOtherUnit;
    case lidar::DecodeStatus::kWrongPoint:
    case lidar::DecodeStatus::kOk:
      break;
  }
  return PacketDrop::kWrongPoint;
}

// For spinning units. A LUX sends fewer packets.
std::uint32_t points_of_packet(const vehicle::Sensor& sensor) {
  constexpr std::uint32_t kSpinning = 384;
  return lidar::facts_of(sensor.format).is_points ? lidar::PointsPacket::kMostPoints : kSpinning;
}

}  // namespace

Intake::Intake(std::span<const vehicle::Sensor> sensors, std::uint32_t replayer_ipv4)
    : sensors_(sensors), replayer_ipv4_(replayer_ipv4) {
  require(sensors.size() <= vehicle::kMaxSensors);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const std::uint32_t packets = sensors[i].max_points_per_scan / points_of_packet(sensors[i]);
    trackers_[i] =
        ScanTracker(lidar::turns(sensors[i].format), sensors[i].azimuths.ticks_per_turn(),
                    sensors[i].scan_width_ticks, packets);
    digests_[i] = RangeDigest(sensors[i]);
    frozen_[i].look_back(trackers_[i].remembered_packets());
  }
}

std::size_t Intake::sensor_of(const Datagram& datagram) const {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const vehicle::Sensor& sensor = sensors_[i];
    if (sensor.udp_port == datagram.destination_port &&
        protection::may_send(datagram.source_ipv4, sensor.source_ipv4, replayer_ipv4_)) {
      return i;
    }
  }
  return kNobody;
}

void Intake::drop(PacketDrop cause) {
  ++packet_drops_[static_cast<std::size_t>(cause)];
  ++packets_dropped_;
}

void Intake::drop(PacketDrop cause, vehicle::Fate fate, const Packet& packet) {
  points_dropped_[static_cast<std::size_t>(fate)] += packet.info().point_count;
  drop(cause);
}

std::optional<SensorPacket> Intake::receive(const Datagram& datagram) {
  const std::size_t sensor = sensor_of(datagram);
  if (sensor == kNobody) {
    drop(PacketDrop::kStranger);
    return std::nullopt;
  }
  const vehicle::Sensor& described = sensors_[sensor];
  std::optional<SensorPacket> received(
      SensorPacket{sensor, Packet::decode(described.format, datagram.payload, described.unit()),
                   datagram.payload});
  lidar::DecodeStatus status = received->packet.status();
  if (status == lidar::DecodeStatus::kOk && !is_of_unit(sensor, received->packet)) {
    status = lidar::DecodeStatus::kOtherUnit;
  }
  if (status != lidar::DecodeStatus::kOk) {
    drop(cause_of(status), vehicle::Fate::kMalformed, received->packet);
    received.reset();
  } else {
    received->range_digest = digests_[sensor].of(received->packet);
  }
  return received;
}

// Uncertain packets are refused. Packets of other makers carry marks of their own, which their
// decoder has checked.
bool Intake::is_of_unit(std::size_t sensor, const Packet& packet) {
  const lidar::VelodyneLook* const look = packet.velodyne_look();
  return look == nullptr ||
         identities_[sensor].add(*look) == lidar::FormatSet(sensors_[sensor].format);
}

Intake::Outcome Intake::classify(const SensorPacket& packet) {
  const ScanTracker& tracker = trackers_[packet.sensor];
  const lidar::PacketInfo& info = packet.packet.info();
  switch (tracker.classify(info)) {
    case ScanTracker::Outcome::kDuplicate:
      drop(PacketDrop::kDuplicate, vehicle::Fate::kStale, packet.packet);
      return Outcome::kDropped;
    case ScanTracker::Outcome::kLate:
      drop(PacketDrop::kLate, vehicle::Fate::kStale, packet.packet);
      return Outcome::kDropped;
    case ScanTracker::Outcome::kTooSoon:
      drop(PacketDrop::kTooSoon, vehicle::Fate::kStale, packet.packet);
      return Outcome::kDropped;
    case ScanTracker::Outcome::kNextScan:
      return Outcome::kNextFrame;
    case ScanTracker::Outcome::kPartOfFrame:
      break;
  }
  if (frozen_[packet.sensor].is_frozen(packet.range_digest)) {
    frozen_[packet.sensor].note_frozen(packet.range_digest);
    drop(PacketDrop::kFrozen, vehicle::Fate::kStale, packet.packet);
    return Outcome::kDropped;
  }
  if (tracker.points() + info.point_count > sensors_[packet.sensor].max_points_per_scan) {
    drop(PacketDrop::kOverBudget, vehicle::Fate::kMalformed, packet.packet);
    return Outcome::kDropped;
  }
  return Outcome::kThisFrame;
}

void Intake::accept(const SensorPacket& packet) {
  trackers_[packet.sensor].accept(packet.packet.info());
  frozen_[packet.sensor].note_taken(packet.range_digest);
  ++packets_accepted_;
}

void Intake::leave(const SensorPacket& packet) {
  drop(PacketDrop::kNotTaken, vehicle::Fate::kNotTaken, packet.packet);
}

bool Intake::is_complete() const {
  const auto trackers = std::span(trackers_).first(sensors_.size());
  return std::ranges::all_of(trackers, &ScanTracker::is_complete);
}

void Intake::start_frame() {
  packets_accepted_ = 0;
  points_dropped_ = {};
  for (ScanTracker& tracker : trackers_) {
    tracker.start_frame();
  }
  for (FrozenWatch& watch : frozen_) {
    watch.start_frame();
  }
}

SensorReport Intake::report_of(std::size_t sensor) const {
  const ScanTracker& tracker = trackers_[sensor];
  SensorState state = SensorState::kPartial;
  if (!tracker.was_ever_seen()) {
    state = SensorState::kNeverSeen;
  } else if (tracker.packets() == 0) {
    state = SensorState::kSilent;
  } else if (tracker.is_complete()) {
    state = SensorState::kComplete;
  }
  return {.state = state,
          .age_frames = tracker.was_ever_seen() ? tracker.age_frames() : std::uint16_t{0xFFFF},
          .packets = tracker.packets(),
          .points = tracker.points(),
          .scan_number = tracker.scan_number()};
}

}  // namespace iog::intake
