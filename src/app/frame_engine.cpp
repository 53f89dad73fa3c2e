#include "app/frame_engine.hpp"

namespace iog::app {
namespace {

// Silence is reported at half the rate of frames.
constexpr std::uint64_t kSilentPeriods = 2;

}  // namespace

FrameEngine::FrameEngine(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4)
    : fusion_(vehicle), vehicle_(&vehicle), intake_(vehicle.sensors, replayer_ipv4) {}

std::optional<intake::SensorPacket> FrameEngine::receive(const intake::Datagram& datagram) {
  return intake_.receive(datagram);
}

FrameEngine::Outcome FrameEngine::classify(const intake::SensorPacket& packet) {
  const Outcome outcome = intake_.classify(packet);
  const vehicle::Sensor& sensor = vehicle_->sensors[packet.sensor];
  if (outcome == Outcome::kThisFrame && !fusion_.fits(sensor, packet.packet.info().point_count)) {
    intake_.refuse(packet);
    return Outcome::kDropped;
  }
  return outcome;
}

void FrameEngine::accept(const intake::SensorPacket& packet, std::uint64_t now_us) {
  if (intake_.packets_accepted() == 0) {
    opened_us_ = now_us;
  }
  intake_.accept(packet);
}

void FrameEngine::add_points(std::size_t sensor, const intake::Packet& packet) {
  add_points_to(fusion_, vehicle_->sensors[sensor], packet, fates_);
}

void FrameEngine::add_points_to(grid::FrameFusion& fusion, const vehicle::Sensor& sensor,
                                const intake::Packet& packet, Fates& fates) {
  fusion.add_all(sensor, packet,
                 [&](vehicle::Fate fate) { ++fates[static_cast<std::size_t>(fate)]; });
}

void FrameEngine::count(const Fates& fates) {
  for (std::size_t fate = 0; fate < fates.size(); ++fate) {
    fates_[fate] += fates[fate];
  }
}

std::uint64_t FrameEngine::deadline_us() const {
  const std::uint64_t periods = intake_.packets_accepted() > 0 ? 1 : kSilentPeriods;
  return opened_us_ + periods * vehicle_->frame_period_us;
}

FrameReport FrameEngine::report(std::uint64_t now_us) const {
  FrameReport report{.number = frame_number_,
                     .opened_us = opened_us_,
                     .closed_us = now_us,
                     .is_timed_out = is_overdue(now_us) && !is_complete(),
                     .vehicle_id = vehicle_->id,
                     .rule = vehicle_->rule,
                     .grids = vehicle_->grids,
                     .sensor_count = vehicle_->sensors.size(),
                     .packets_fused = intake_.packets_accepted(),
                     .packets_dropped = intake_.packets_dropped(),
                     .packet_drops = intake_.packet_drops(),
                     .fates = fates_};
  using vehicle::Fate;
  for (const Fate fate : {Fate::kMalformed, Fate::kStale, Fate::kNotTaken}) {
    report.fates[static_cast<std::size_t>(fate)] += intake_.points_dropped(fate);
  }
  for (std::size_t i = 0; i < report.sensor_count; ++i) {
    report.sensors[i] = intake_.report_of(i);
  }
  return report;
}

void FrameEngine::start_next(std::uint64_t now_us) {
  ++frame_number_;
  opened_us_ = now_us;
  fates_ = {};
  intake_.start_frame();
}

}  // namespace iog::app
