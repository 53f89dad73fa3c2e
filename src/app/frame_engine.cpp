#include "app/frame_engine.hpp"

#include "require/require.hpp"
#include "stream/crc32.hpp"

namespace iog::app {
namespace {

// Silence is reported at half the rate of frames.
constexpr std::uint64_t kSilentPeriods = 2;

std::uint32_t id_of(std::string_view name) {
  stream::Crc32 crc;
  crc.update(std::as_bytes(std::span(name)));
  return crc.value();
}

// PacketDrop has a cause for each way in which decoding fails, in the same order.
stream::PacketDrop cause_of(lidar::DecodeStatus status) {
  switch (status) {
    case lidar::DecodeStatus::kWrongLength:
      return stream::PacketDrop::kWrongLength;
    case lidar::DecodeStatus::kWrongType:
      return stream::PacketDrop::kWrongType;
    case lidar::DecodeStatus::kWrongAngle:
      return stream::PacketDrop::kWrongAngle;
    case lidar::DecodeStatus::kWrongPoint:
    case lidar::DecodeStatus::kOk:
      break;
  }
  return stream::PacketDrop::kWrongPoint;
}

}  // namespace

FrameEngine::FrameEngine(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4,
                         std::uint64_t start_us)
    : vehicle_(&vehicle),
      replayer_ipv4_(replayer_ipv4),
      vehicle_id_(id_of(vehicle.name)),
      opened_us_(start_us),
      fusion_(vehicle) {
  require(vehicle.sensors.size() <= vehicle::kMaxSensors);
  for (std::size_t i = 0; i < vehicle.sensors.size(); ++i) {
    const vehicle::Sensor& sensor = vehicle.sensors[i];
    trackers_[i] = ScanTracker(sensor.sines.ticks_per_turn(), sensor.scan_width_ticks);
  }
}

std::size_t FrameEngine::sensor_of(const SensorDatagram& datagram) const {
  for (std::size_t i = 0; i < vehicle_->sensors.size(); ++i) {
    const vehicle::Sensor& sensor = vehicle_->sensors[i];
    const bool may_send = sensor.source_ipv4 == 0 || sensor.source_ipv4 == datagram.source_ipv4 ||
                          (replayer_ipv4_ != 0 && replayer_ipv4_ == datagram.source_ipv4);
    if (sensor.udp_port == datagram.destination_port && may_send) {
      return i;
    }
  }
  return kNobody;
}

lidar::DecodeStatus FrameEngine::decode(std::size_t sensor, std::span<const std::byte> payload) {
  return vehicle_->sensors[sensor].format == lidar::Format::kIbeoLux ? lux_.decode(payload)
                                                                     : vlp16_.decode(payload);
}

const lidar::PacketInfo& FrameEngine::packet() const {
  return vehicle_->sensors[sensor_].format == lidar::Format::kIbeoLux ? lux_.info() : vlp16_.info();
}

FrameEngine::Inspection FrameEngine::drop(stream::PacketDrop cause) {
  ++packet_drops_[static_cast<std::size_t>(cause)];
  ++packets_dropped_;
  sensor_ = kNobody;
  return Inspection::kDropped;
}

FrameEngine::Inspection FrameEngine::inspect(const SensorDatagram& datagram) {
  sensor_ = sensor_of(datagram);
  if (sensor_ == kNobody) {
    return drop(stream::PacketDrop::kStranger);
  }
  const lidar::DecodeStatus status = decode(sensor_, datagram.payload);
  if (status != lidar::DecodeStatus::kOk) {
    fates_[static_cast<std::size_t>(vehicle::Fate::kMalformed)] += packet().point_count;
    return drop(cause_of(status));
  }
  const ScanTracker& tracker = trackers_[sensor_];
  switch (tracker.judge(packet())) {
    case ScanTracker::Verdict::kDuplicate:
      return drop(stream::PacketDrop::kDuplicate);
    case ScanTracker::Verdict::kLate:
      return drop(stream::PacketDrop::kLate);
    case ScanTracker::Verdict::kNextScan:
      return Inspection::kNextFrame;
    case ScanTracker::Verdict::kPartOfFrame:
      break;
  }
  const vehicle::Sensor& sensor = vehicle_->sensors[sensor_];
  const std::uint32_t points = packet().point_count;
  if (tracker.points() + points > sensor.max_points_per_scan || !fusion_.fits(sensor, points)) {
    fates_[static_cast<std::size_t>(vehicle::Fate::kMalformed)] += points;
    return drop(stream::PacketDrop::kOverBudget);
  }
  return Inspection::kThisFrame;
}

void FrameEngine::fuse(std::uint64_t now_us) {
  require(sensor_ != kNobody);
  if (packets_fused_ == 0) {
    opened_us_ = now_us;
  }
  ++packets_fused_;
  trackers_[sensor_].accept(packet());
  const vehicle::Sensor& sensor = vehicle_->sensors[sensor_];
  const auto add = [&](const lidar::ScanPoint& point) {
    ++fates_[static_cast<std::size_t>(fusion_.add(sensor, point))];
  };
  if (sensor.format == lidar::Format::kIbeoLux) {
    lux_.for_each_point(add);
  } else {
    vlp16_.for_each_point(add);
  }
  sensor_ = kNobody;
}

bool FrameEngine::is_complete() const {
  for (std::size_t i = 0; i < vehicle_->sensors.size(); ++i) {
    if (!trackers_[i].is_complete()) {
      return false;
    }
  }
  return true;
}

std::uint64_t FrameEngine::deadline_us() const {
  const std::uint64_t periods = packets_fused_ > 0 ? 1 : kSilentPeriods;
  return opened_us_ + periods * vehicle_->frame_period_us;
}

stream::SensorReport FrameEngine::report_of(std::size_t sensor) const {
  const ScanTracker& tracker = trackers_[sensor];
  stream::SensorState state = stream::SensorState::kPartial;
  if (!tracker.was_ever_seen()) {
    state = stream::SensorState::kNeverSeen;
  } else if (tracker.packets() == 0) {
    state = stream::SensorState::kSilent;
  } else if (tracker.is_complete()) {
    state = stream::SensorState::kComplete;
  }
  return {.state = state,
          .age_frames = tracker.was_ever_seen() ? tracker.age_frames() : std::uint16_t{0xFFFF},
          .packets = tracker.packets(),
          .points = tracker.points(),
          .scan_number = tracker.scan_number()};
}

void FrameEngine::report(std::uint64_t now_us, stream::Header& header,
                         stream::FrameEnd& end) const {
  header.frame_number = frame_number_;
  header.closed_us = now_us;
  header.vehicle_id = vehicle_id_;
  header.sensor_count = static_cast<std::uint8_t>(vehicle_->sensors.size());
  header.complete_sensors = 0;
  header.partial_sensors = 0;
  for (std::size_t i = 0; i < vehicle_->sensors.size(); ++i) {
    end.sensors[i] = report_of(i);
    const auto bit = static_cast<std::uint8_t>(1U << i);
    header.complete_sensors |=
        end.sensors[i].state == stream::SensorState::kComplete ? bit : std::uint8_t{0};
    header.partial_sensors |=
        end.sensors[i].state == stream::SensorState::kPartial ? bit : std::uint8_t{0};
  }
  header.flags = is_overdue(now_us) && !is_complete() ? stream::kFlagTimedOut : std::uint8_t{0};
  header.flags |=
      vehicle_->rule == vehicle::FusionRule::kBayes ? stream::kFlagBayes : std::uint8_t{0};
  header.points_used = fates_[static_cast<std::size_t>(vehicle::Fate::kUsed)];
  header.points_other = 0;
  for (const std::uint32_t count : fates_) {
    header.points_other += count;
  }
  header.points_other -= header.points_used;
  header.packets_fused = packets_fused_;
  header.packets_dropped = packets_dropped_;
  end.opened_us = opened_us_;
  end.fates = fates_;
  end.packet_drops = packet_drops_;
}

void FrameEngine::start_next(std::uint64_t now_us) {
  ++frame_number_;
  opened_us_ = now_us;
  packets_fused_ = 0;
  fates_ = {};
  for (ScanTracker& tracker : trackers_) {
    tracker.start_frame();
  }
}

}  // namespace iog::app
