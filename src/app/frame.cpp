#include "app/frame.hpp"

#include <algorithm>
#include <numeric>
#include <span>

#include "grid/pending_marks.hpp"
#include "require/require.hpp"

namespace iog::app {
namespace {

using intake::SensorState;
using vehicle::Fate;

// Silence is reported at half the frame rate.
constexpr std::uint64_t kSilentPeriods = 2;

// More points than any LUX sends in a scan, and fewer than any rotating lidar sends in a turn.
constexpr std::uint32_t kDensePoints = 16'384;

// Points that make a part worth a round: 16 packets of a Velodyne.
constexpr std::size_t kPointsOfPart = 6'144;

std::uint64_t most_marks_of(const vehicle::Vehicle& vehicle) {
  std::uint64_t marks = 0;
  for (const vehicle::Sensor& sensor : vehicle.sensors) {
    marks += std::uint64_t{sensor.max_points_per_scan} * grid::max_marks_per_point(sensor);
  }
  return marks;
}

// Bit i: sensor i is in this state.
std::uint8_t sensors_in_state(std::span<const intake::SensorReport> sensors, SensorState state) {
  unsigned bits = 0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    bits |= sensors[i].state == state ? 1U << i : 0U;
  }
  return static_cast<std::uint8_t>(bits);
}

}  // namespace

bool is_fused_together(const vehicle::Vehicle& vehicle) {
  return vehicle.rule == vehicle::FusionRule::kHitsWin &&
         std::ranges::any_of(vehicle.sensors, [](const vehicle::Sensor& sensor) {
           return sensor.max_points_per_scan > kDensePoints;
         });
}

Frame::Frame(const vehicle::Vehicle& vehicle, std::uint32_t replayer_ipv4,
             fusion::HelpersSpace space, Fusing fusing)
    : fusion_(vehicle, watched_, space),
      vehicle_(&vehicle),
      fusing_(fusing),
      may_share_(is_fused_together(vehicle)),
      intake_(vehicle.sensors, replayer_ipv4),
      watched_(vehicle.sensors) {
  require(most_marks_of(vehicle) <= grid::kMaxMarks);
}

void Frame::accept(const intake::SensorPacket& packet, std::uint64_t now_us) {
  if (!is_begun()) {
    opened_us_ = now_us;
  }
  intake_.accept(packet);
  watched_.add(packet.sensor, packet.packet);
}

// A frame keeps the mode in which it began, even if cores are lost meanwhile.
void Frame::fuse(const intake::SensorPacket& packet, std::uint64_t now_us, const work::Crew& crew) {
  if (!is_begun()) {
    is_shared_ = may_share_ && !crew.is_one();
  }
  accept(packet, now_us);
  if (!is_shared_) {
    fusion_.fuse_alone(packet.sensor, packet.packet);
    return;
  }
  fusion::FramePackets& packets = fusion_.packets();
  if (!packets.fits(packet)) {
    fuse_kept(crew);
  }
  packets.keep(packet, now_us);
  if (packets.points() >= kPointsOfPart * crew.cores()) {
    fuse_kept(crew);
  }
}

std::uint64_t Frame::deadline_us() const {
  const std::uint64_t periods = is_begun() ? 1 : kSilentPeriods;
  return opened_us_ + periods * vehicle_->frame_period_us;
}

void Frame::describe(std::uint64_t now_us, stream::Header& header, stream::FrameEnd& end) {
  const intake::Surroundings surroundings = watched_.at_end(intake_, now_us);
  end.opened_us = opened_us_;
  end.fates = fusion_.fates();
  for (const Fate fate : {Fate::kMalformed, Fate::kStale, Fate::kNotTaken}) {
    end.fates[static_cast<std::size_t>(fate)] += intake_.points_dropped(fate);
  }
  end.packet_drops = intake_.packet_drops();
  end.unwatched = surroundings.unwatched;
  end.blocked = surroundings.blocked;
  const std::size_t sensors = vehicle_->sensors.size();
  for (std::size_t i = 0; i < sensors; ++i) {
    end.sensors[i] = intake_.report_of(i);
    end.sensors[i].blocked = surroundings.sensors[i];
  }
  const auto in_state = [&](SensorState state) {
    return sensors_in_state(std::span(end.sensors).first(sensors), state);
  };
  const bool is_timed_out = is_overdue(now_us) && !is_complete();
  const unsigned timed_out = is_timed_out ? stream::kFlagTimedOut : 0U;
  const unsigned bayes = vehicle_->rule == vehicle::FusionRule::kBayes ? stream::kFlagBayes : 0U;
  const std::uint32_t used = end.fates[static_cast<std::size_t>(Fate::kUsed)];
  header = {.flags = static_cast<std::uint8_t>(timed_out | bayes),
            .frame_number = number_,
            .closed_us = now_us,
            .vehicle_id = vehicle_->id,
            .sensor_count = static_cast<std::uint8_t>(sensors),
            .complete_sensors = in_state(SensorState::kComplete),
            .partial_sensors = in_state(SensorState::kPartial),
            .points_used = used,
            .points_other = std::accumulate(end.fates.begin(), end.fates.end(), 0U) - used,
            .packets_fused = intake_.packets_accepted(),
            .packets_dropped = intake_.packets_dropped(),
            .epsilon_e5 = vehicle_->epsilon_e5};
}

void Frame::start_next(std::uint64_t now_us) {
  watched_.end_frame(intake_, now_us);
  ++number_;
  opened_us_ = now_us;
  is_shared_ = false;
  fusion_.start_next();
  intake_.start_frame();
}

}  // namespace iog::app
