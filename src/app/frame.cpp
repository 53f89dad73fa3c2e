#include "app/frame.hpp"

#include <numeric>
#include <span>

#include "grid/pending_marks.hpp"
#include "require/require.hpp"

namespace iog::app {
namespace {

using intake::SensorState;
using vehicle::Fate;

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
  fusion.add_all(sensor, packet, [&](Fate fate) { ++fates[static_cast<std::size_t>(fate)]; });
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

void Frame::describe(std::uint64_t now_us, stream::Header& header, stream::FrameEnd& end) const {
  const intake::Surroundings surroundings = watched_.at_end(intake_, now_us);
  end.opened_us = opened_us_;
  end.fates = fates_;
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
            .packets_dropped = intake_.packets_dropped()};
}

void Frame::start_next(std::uint64_t now_us) {
  watched_.end_frame(intake_, now_us);
  ++number_;
  opened_us_ = now_us;
  fates_ = {};
  intake_.start_frame();
}

}  // namespace iog::app
