#include "app/frame.hpp"

#include "grid/pending_marks.hpp"
#include "require/require.hpp"

namespace iog::app {
namespace {

// Silence is reported at half the rate of frames.
constexpr std::uint64_t kSilentPeriods = 2;

std::uint64_t most_marks_of(const vehicle::Vehicle& vehicle) {
  std::uint64_t marks = 0;
  for (const vehicle::Sensor& sensor : vehicle.sensors) {
    marks += std::uint64_t{sensor.max_points_per_scan} * grid::max_marks_per_point(sensor);
  }
  return marks;
}

template <typename Packet>
void add_all(grid::FrameFusion& fusion, const vehicle::Sensor& sensor, const Packet& packet,
             Fates& fates) {
  fusion.add_all(sensor, packet,
                 [&](vehicle::Fate fate) { ++fates[static_cast<std::size_t>(fate)]; });
}

}  // namespace

void Frame::add_points(grid::FrameFusion& fusion, std::size_t sensor, const intake::Packet& packet,
                       Fates& fates) const {
  const vehicle::Sensor& its = vehicle_->sensors[sensor];
  if (its.no_return_clears_mm == 0) {
    add_all(fusion, its, packet, fates);
  } else {
    const intake::AzimuthParts silent = watched_.silent_azimuths(sensor, packet);
    add_all(fusion, its, intake::EvidentPacket(packet, silent), fates);
  }
}

Frame::Frame(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4)
    : vehicle_(&vehicle), intake_(vehicle.sensors, replayer_ipv4), watched_(vehicle.sensors) {
  require(most_marks_of(vehicle) <= grid::kMaxMarks);
}

void Frame::accept(const intake::SensorPacket& packet, std::uint64_t now_us) {
  if (!is_begun()) {
    opened_us_ = now_us;
  }
  intake_.accept(packet);
  watched_.add(packet.sensor, packet.packet);
}

void Frame::count(const Fates& fates) {
  for (std::size_t fate = 0; fate < fates.size(); ++fate) {
    fates_[fate] += fates[fate];
  }
}

std::uint64_t Frame::deadline_us() const {
  const std::uint64_t periods = is_begun() ? 1 : kSilentPeriods;
  return opened_us_ + periods * vehicle_->frame_period_us;
}

FrameReport Frame::report(std::uint64_t now_us) const {
  const intake::Surroundings surroundings = watched_.at_end(intake_, now_us);
  FrameReport report{.number = number_,
                     .opened_us = opened_us_,
                     .closed_us = now_us,
                     .is_timed_out = is_overdue(now_us) && !is_complete(),
                     .vehicle_id = vehicle_->id,
                     .rule = vehicle_->rule,
                     .grids = vehicle_->grids,
                     .has_objects = vehicle_->has_objects,
                     .has_receptions = vehicle_->depends_on_arrival(),
                     .sensor_count = vehicle_->sensors.size(),
                     .unwatched = surroundings.unwatched,
                     .blocked = surroundings.blocked,
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
    report.sensors[i].blocked = surroundings.sensors[i];
  }
  return report;
}

void Frame::start_next(std::uint64_t now_us) {
  watched_.end_frame(intake_, now_us);
  ++number_;
  opened_us_ = now_us;
  fates_ = {};
  intake_.start_frame();
}

}  // namespace iog::app
