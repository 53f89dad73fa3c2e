#include "tools/identity/car_clocks.hpp"

#include <algorithm>
#include <cmath>

#include "intake/measurement_time.hpp"
#include "intake/packet.hpp"
#include "lidar/scanner_facts.hpp"
#include "pose/message.hpp"
#include "tools/program/fixed.hpp"
#include "tools/program/middle.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kEnough = 25;  // packets of a sensor
// Transport takes less than this, and clocks that differ by mistake differ by more.
constexpr std::int64_t kAgreeUs = 250'000;
constexpr std::int64_t kWholeSecondUs = 1'000'000;

// Clocks that somebody set differ by whole seconds; the rest is transport.
std::int64_t without_way(std::int64_t ahead_us) {
  constexpr std::int64_t kOnTheWayUs = 100'000;
  const std::int64_t whole_us = std::llround(static_cast<double>(ahead_us) / 1e6) * kWholeSecondUs;
  return std::abs(ahead_us - whole_us) < kOnTheWayUs ? whole_us : ahead_us;
}

std::string words_of(const std::string& who, std::int64_t measured_us) {
  const std::int64_t ahead_us = without_way(measured_us);
  const double ahead_s = static_cast<double>(ahead_us) / 1e6;
  return who + " are " + fixed(std::abs(ahead_s), 3) + " s " +
         (ahead_us > 0 ? "ahead of" : "behind") + " the poses: --clock-offset " +
         fixed(ahead_s, ahead_us % kWholeSecondUs == 0 ? 0 : 3) + " adds it to these";
}

}  // namespace

void CarClocks::Span::add(std::uint64_t time_us) {
  first_us = std::min(first_us, time_us);
  last_us = std::max(last_us, time_us);
}

std::string CarClocks::Span::words() const {
  return " (" + fixed(static_cast<double>(first_us) / 1e6, 3) + " to " +
         fixed(static_cast<double>(last_us) / 1e6, 3) + " s)";
}

void CarClocks::use_log(std::int64_t ahead_us) {
  is_of_log_ = true;
  poses_us_ = ahead_us;
}

void CarClocks::add(const CapturedDatagram& datagram) {
  const std::size_t sensor = sensor_of_port(*car_, datagram.destination.port);
  if (is_pose_port(*car_, datagram.destination.port)) {
    add_pose(datagram);
  } else if (sensor < car_->sensors.size()) {
    packets_.add(datagram.time_us);
    add_packet(datagram, sensor);
  }
}

void CarClocks::add_pose(const CapturedDatagram& datagram) {
  const auto [fate, message] = pose::decode(datagram.payload);
  if (fate != pose::Fate::kUsed) {
    return;
  }
  first_pose_us_ = poses_.first_us > poses_.last_us ? message.clock_us : first_pose_us_;
  poses_.add(datagram.time_us);
  last_pose_us_ = message.clock_us;
  const std::int64_t ahead_us =
      microseconds_later(message.clock_us + message.age_us, datagram.time_us);
  poses_us_ = poses_us_.value_or(ahead_us);
  if (!is_of_log_) {
    pose_step_.add(ahead_us, datagram.time_us);
  }
}

// What counts from the hour needs a pose to say which; beside a log the capture says it.
void CarClocks::add_packet(const CapturedDatagram& datagram, std::size_t number) {
  const vehicle::Sensor& sensor = car_->vehicle->sensors[number];
  const intake::Packet packet =
      intake::Packet::decode(sensor.format, datagram.payload, sensor.unit());
  if (!packet.is_sound()) {
    lost_[number].skip();
    return;
  }
  const lidar::ScannerFacts facts = lidar::facts_of(sensor.format);
  if (!facts.is_points && !facts.marks_arcs()) {
    lost_[number].add(packet.info(), datagram.source.ipv4, facts.turns ? facts.ticks_per_turn : 0);
  }
  paces_[number].add(packet.info().sweep.begin_us, datagram.time_us);
  note(datagram.source.ipv4, datagram.time_us, heard_[number]);
  if (!sensor.is_synchronised || !vehicle::have_classes(car_->vehicle->grids)) {
    return;
  }
  std::vector<std::int64_t>& ahead_us = sensors_us_[number];
  if (!poses_us_) {
    return;
  }
  const std::uint64_t about_us = is_of_log_ ? datagram.time_us : last_pose_us_;
  const std::int64_t its_us =
      microseconds_later(intake::measured_us(sensor, packet.info(), about_us), datagram.time_us);
  if (ahead_us.size() < kEnough) {
    ahead_us.push_back(its_us);
  }
  steps_[number].add(its_us, datagram.time_us);
}

std::vector<std::string> CarClocks::words_of_lost() const {
  std::vector<std::string> all;
  for (const auto& [sensor, lost] : lost_) {
    all.push_back(lost.words(std::string(car_->sensors[sensor].name)));
  }
  std::erase(all, "");
  return all;
}

// If the capture's clock was set, that of its poses steps with the sensor's.
std::string CarClocks::words_of_step() const {
  const std::optional<ClockStep::Found>& of_poses = pose_step_.found();
  const auto is_of_capture = [&of_poses](const ClockStep::Found& found) {
    return of_poses && std::abs(found.step_us - of_poses->step_us) < kAgreeUs / 2 &&
           std::abs(microseconds_later(found.time_us, of_poses->time_us)) <= kWholeSecondUs;
  };
  for (const auto& [sensor, step] : steps_) {
    if (step.found() && !is_of_capture(*step.found())) {
      const std::int64_t found_us = step.found()->step_us;
      const std::int64_t step_us =
          std::abs(found_us) < kWholeSecondUs ? found_us : without_way(found_us);
      return "the clock of " + std::string(car_->sensors[sensor].name) + " steps by " +
             fixed(static_cast<double>(step_us) / 1e6, 3) + " s at " +
             fixed(static_cast<double>(step.found()->time_us) / 1e6, 3) +
             " s of the capture, as if it was set: no single offset fits. Cut the capture there";
    }
  }
  return {};
}

bool CarClocks::are_known() const {
  return poses_us_ && packets_.last_us > 0 && std::ranges::all_of(sensors_us_, [](const auto& its) {
           return its.second.size() == kEnough;
         });
}

std::int64_t CarClocks::sensors_us() const {
  const auto known =
      std::ranges::find_if(sensors_us_, [](const auto& its) { return !its.second.empty(); });
  const std::int64_t ahead_us = known == sensors_us_.end() ? 0 : middle_value_of(known->second);
  return std::abs(ahead_us) <= kAgreeUs ? 0 : without_way(ahead_us);
}

std::string CarClocks::words() const {
  if (!poses_us_ || packets_.last_us == 0) {
    return {};
  }
  if (std::string step = words_of_step(); !step.empty()) {
    return step;
  }
  std::string some;
  std::int64_t some_us = 0;
  std::size_t agreeing = 0;
  for (const auto& [sensor, ahead_us] : sensors_us_) {
    const std::int64_t its_us = ahead_us.empty() ? 0 : middle_value_of(ahead_us) - *poses_us_;
    if (std::abs(its_us) <= kAgreeUs) {
      ++agreeing;
    } else {
      some += (some.empty() ? "" : ", ") + std::string(car_->sensors[sensor].name);
      some_us = its_us;
    }
  }
  if (!some.empty()) {
    return words_of(agreeing == 0 ? "the packets" : "the packets of " + some, some_us) +
           (is_of_log_ ? ", and --clock-offset 0 says that the log is by the packets' clock" : "");
  }
  return poses_.last_us < packets_.first_us || packets_.last_us < poses_.first_us ? words_apart()
                                                                                  : "";
}

std::string CarClocks::words_apart() const {
  constexpr std::uint64_t kYear2100Us = 4'102'444'800'000'000;
  if (packets_.first_us > kYear2100Us) {
    return "the times of the packets" + packets_.words() +
           " are beyond the year 2100, so the capture counts them in another unit: convert or "
           "record it again";
  }
  return "the packets" + packets_.words() + " and the poses" + poses_.words() +
         " have no time in common: if they begin together, " +
         words_of("the packets",
                  microseconds_later(packets_.first_us, first_pose_us_) + sensors_us());
}

}  // namespace iog::tools
