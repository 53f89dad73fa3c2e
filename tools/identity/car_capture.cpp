#include "tools/identity/car_capture.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <utility>

#include "intake/measurement_time.hpp"
#include "intake/packet.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kEnough = 25;  // packets of a sensor
// Transport takes less than this, and clocks that differ by mistake differ by more.
constexpr std::int64_t kAgreeUs = 250'000;
constexpr std::int64_t kSecondUs = 1'000'000;

std::int64_t difference(std::uint64_t later_us, std::uint64_t earlier_us) {
  return static_cast<std::int64_t>(later_us - earlier_us);
}

std::int64_t middle_of(std::vector<std::int64_t> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// Clocks that somebody set differ by whole seconds; the rest is transport.
std::int64_t without_way(std::int64_t ahead_us) {
  constexpr std::int64_t kOnTheWayUs = 100'000;
  const std::int64_t whole_us = std::llround(static_cast<double>(ahead_us) / 1e6) * kSecondUs;
  return std::abs(ahead_us - whole_us) < kOnTheWayUs ? whole_us : ahead_us;
}

std::string words_of(const std::string& who, std::int64_t measured_us) {
  const std::int64_t ahead_us = without_way(measured_us);
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << who << " are "
       << static_cast<double>(std::abs(ahead_us)) / 1e6 << " s "
       << (ahead_us > 0 ? "ahead of" : "behind") << " the poses: --clock-offset "
       << std::setprecision(ahead_us % kSecondUs == 0 ? 0 : 3)
       << static_cast<double>(ahead_us) / 1e6 << " adds it to these";
  return text.str();
}

}  // namespace

void CarClocks::Span::add(std::uint64_t time_us) {
  first_us = std::min(first_us, time_us);
  last_us = std::max(last_us, time_us);
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
  poses_.add(datagram.time_us);
  last_pose_us_ = message.clock_us;
  if (!poses_us_) {
    first_pose_us_ = message.clock_us;
    poses_us_ = difference(message.clock_us + message.age_us, datagram.time_us);
  }
}

// What counts from the hour needs a pose to say which.
void CarClocks::add_packet(const CapturedDatagram& datagram, std::size_t number) {
  const vehicle::Sensor& sensor = car_->vehicle->sensors[number];
  if (!sensor.is_synchronised || !vehicle::have_classes(car_->vehicle->grids)) {
    return;
  }
  std::vector<std::int64_t>& ahead_us = sensors_us_[number];
  if (ahead_us.size() == kEnough || !poses_us_) {
    return;
  }
  const intake::Packet packet =
      intake::Packet::decode(sensor.format, datagram.payload, sensor.unit());
  if (packet.is_sound()) {
    ahead_us.push_back(
        difference(intake::measured_us(sensor, packet.info(), last_pose_us_), datagram.time_us));
  }
}

bool CarClocks::are_known() const {
  return poses_us_ && packets_.last_us > 0 && std::ranges::all_of(sensors_us_, [](const auto& its) {
           return its.second.size() == kEnough;
         });
}

std::int64_t CarClocks::sensors_us() const {
  const auto known =
      std::ranges::find_if(sensors_us_, [](const auto& its) { return !its.second.empty(); });
  const std::int64_t ahead_us = known == sensors_us_.end() ? 0 : middle_of(known->second);
  return std::abs(ahead_us) < kSecondUs ? 0 : ahead_us;
}

std::string CarClocks::words() const {
  if (!poses_us_ || packets_.last_us == 0) {
    return {};
  }
  std::string some;
  std::int64_t some_us = 0;
  std::size_t agreeing = 0;
  for (const auto& [sensor, ahead_us] : sensors_us_) {
    const std::int64_t its_us = ahead_us.empty() ? 0 : middle_of(ahead_us) - *poses_us_;
    if (std::abs(its_us) <= kAgreeUs) {
      ++agreeing;
    } else {
      some += (some.empty() ? "" : ", ") + std::string(car_->sensors[sensor].name);
      some_us = its_us;
    }
  }
  if (!some.empty()) {
    return words_of(agreeing == 0 ? "the packets" : "the packets of " + some, some_us);
  }
  if (poses_.last_us < packets_.first_us || packets_.last_us < poses_.first_us) {
    return "the packets and the poses have no time in common: if they begin together, " +
           words_of("the packets", difference(packets_.first_us, first_pose_us_) + sensors_us());
  }
  return {};
}

CarCapture::CarCapture(const std::string& path, const CatalogueEntry& car, double clock_offset_s)
    : car_(&car), offset_us_(std::llround(clock_offset_s * 1e6)), file_(path), clocks_(car) {
  if (offset_us_ == 0) {
    return;
  }
  if (!std::filesystem::is_regular_file(path)) {
    throw UsageError("--clock-offset needs a file, which is read twice, not " + path);
  }
  if (const std::int64_t delay_us = delay_of_poses(path); delay_us != 0) {
    read_poses(path, delay_us);
  }
}

// Poses belong to packets of the same measuring time. If they arrive less than a second apart from
// these, their times stay.
std::int64_t CarCapture::delay_of_poses(const std::string& path) const {
  PcapReader file(path);
  CarClocks clocks(*car_);
  while (!clocks.are_known()) {
    const std::optional<CapturedDatagram> datagram = file.next();
    if (!datagram) {
      break;
    }
    clocks.add(*datagram);
  }
  const std::int64_t delay_us = clocks.poses_us() + offset_us_ - clocks.sensors_us();
  return std::abs(delay_us) < kSecondUs ? 0 : delay_us;
}

void CarCapture::read_poses(const std::string& path, std::int64_t delay_us) {
  is_merged_ = true;
  PcapReader file(path);
  while (std::optional<CapturedDatagram> datagram = file.next()) {
    if (is_pose_port(*car_, datagram->destination.port)) {
      datagram->time_us += static_cast<std::uint64_t>(delay_us);
      poses_.push_back(*std::move(datagram));
    }
  }
}

std::optional<PcapReader::Place> CarCapture::place() const {
  return is_merged_ ? std::nullopt : file_.place();
}

void CarCapture::put_ahead(CapturedDatagram& pose) {
  auto [fate, message] = pose::decode(pose.payload);
  if (offset_us_ == 0 || fate != pose::Fate::kUsed) {
    return;
  }
  message.clock_us += static_cast<std::uint64_t>(offset_us_);
  const auto bytes = encoder_.encode(message);
  pose.payload.assign(bytes.begin(), bytes.end());
}

std::optional<CapturedDatagram> CarCapture::next() {
  std::optional<CapturedDatagram> datagram = std::exchange(packet_, std::nullopt);
  while (!datagram && (datagram = file_.next()) && is_merged_ &&
         is_pose_port(*car_, datagram->destination.port)) {
    datagram.reset();
  }
  if (next_pose_ < poses_.size() &&
      (!datagram || poses_[next_pose_].time_us <= datagram->time_us)) {
    packet_ = std::exchange(datagram, std::move(poses_[next_pose_++]));
  }
  if (datagram && is_pose_port(*car_, datagram->destination.port)) {
    put_ahead(*datagram);
  }
  if (datagram) {
    clocks_.add(*datagram);
  }
  return datagram;
}

void warn_of(const std::string& path, const CarCapture& capture) {
  warn_of(path, capture.file());
  if (const std::string words = capture.clock_words(); !words.empty()) {
    std::cerr << "iog: " << path << ": " << words << '\n';
  }
}

}  // namespace iog::tools
