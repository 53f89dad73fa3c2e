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
#include "pose/limits.hpp"
#include "tools/odometry/motion_offset.hpp"
#include "tools/poses/pose_encoder.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/joined.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kEnough = 25;  // packets of a sensor
// Transport takes less than this, and clocks that differ by mistake differ by more.
constexpr std::int64_t kAgreeUs = 250'000;
constexpr std::int64_t kSecondUs = 1'000'000;
// For an offset by motion: two minutes have some bends.
constexpr double kEnoughMotionS = 120;

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

// Poses of a lidar become those of the car by its mount.
PoseConversion conversion_of(const DriveFiles& drive, const CatalogueEntry& car, bool is_of_unit) {
  std::vector<double> at = drive.poses_mount;
  if (at.empty() && is_of_unit) {
    if (car.sensors.size() > 1) {
      throw UsageError(drive.poses + ": poses of a lidar, and " + std::string(car.vehicle->name) +
                       " has several sensors: give --poses-mount X Y YAW of that one");
    }
    const description::MountConfig& mount = car.sensors[0].mount;
    at = {mount.x_m, mount.y_m, mount.yaw_deg};
  }
  at.resize(3);
  return {.mount_x_m = at[0], .mount_y_m = at[1], .mount_yaw_rad = at[2] * kRadians};
}

}  // namespace

ConvertedLog log_of(const DriveFiles& drive, const CatalogueEntry& car) {
  PoseLog log = read_pose_log(drive.poses);
  const PoseConversion conversion = conversion_of(drive, car, log.is_of_unit);
  ConvertedLog poses = converted(std::move(log), conversion);
  demand_poses(poses, drive.poses);
  return poses;
}

std::string DriveFiles::name() const { return joined(captures, ", "); }

void CarClocks::Span::add(std::uint64_t time_us) {
  first_us = std::min(first_us, time_us);
  last_us = std::max(last_us, time_us);
}

std::string CarClocks::Span::words() const {
  std::ostringstream text;
  text << std::fixed << std::setprecision(3) << " (" << static_cast<double>(first_us) / 1e6
       << " to " << static_cast<double>(last_us) / 1e6 << " s)";
  return text.str();
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
  if (!poses_us_) {
    poses_us_ = difference(message.clock_us + message.age_us, datagram.time_us);
  }
}

// What counts from the hour needs a pose to say which; beside a log the capture says it.
void CarClocks::add_packet(const CapturedDatagram& datagram, std::size_t number) {
  const vehicle::Sensor& sensor = car_->vehicle->sensors[number];
  const intake::Packet packet =
      intake::Packet::decode(sensor.format, datagram.payload, sensor.unit());
  if (!packet.is_sound()) {
    return;
  }
  paces_[number].add(packet.info().sweep.begin_us, datagram.time_us);
  note(datagram.source.ipv4, datagram.time_us, heard_[number]);
  if (!sensor.is_synchronised || !vehicle::have_classes(car_->vehicle->grids)) {
    return;
  }
  std::vector<std::int64_t>& ahead_us = sensors_us_[number];
  if (ahead_us.size() == kEnough || !poses_us_) {
    return;
  }
  const std::uint64_t about_us = is_of_log_ ? datagram.time_us : last_pose_us_;
  ahead_us.push_back(
      difference(intake::measured_us(sensor, packet.info(), about_us), datagram.time_us));
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
  return std::abs(ahead_us) <= kAgreeUs ? 0 : without_way(ahead_us);
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
         words_of("the packets", difference(packets_.first_us, first_pose_us_) + sensors_us());
}

CarCapture::CarCapture(const DriveFiles& drive, const CatalogueEntry& car)
    : car_(&car),
      has_log_(!drive.poses.empty()),
      offset_us_(std::llround(drive.clock_offset_s.value_or(0) * 1e6)),
      files_(drive.captures),
      clocks_(car),
      senders_(car) {
  if (drive.finds_clock_offset && !has_log_) {
    throw UsageError("--clock-offset auto needs --poses, a log whose motion is compared");
  }
  if (!has_log_ && offset_us_ == 0) {
    return;
  }
  for (const std::string& path : drive.captures) {
    if (!std::filesystem::is_regular_file(path)) {
      throw UsageError(std::string(has_log_ ? "--poses" : "--clock-offset") +
                       " needs a file, which is read twice, not " + path);
    }
  }
  if (has_log_) {
    read_log(drive);
  }
  const std::int64_t delay_us = delay_of_poses(drive);
  is_merged_ = has_log_ || delay_us != 0;
  if (has_log_) {
    clocks_.use_log(offset_us_ - delay_us);
  } else if (is_merged_) {
    read_poses(drive);
  }
  for (CapturedDatagram& pose : poses_) {
    pose.time_us += static_cast<std::uint64_t>(delay_us);
  }
}

// An offset by motion is of the captures' clock. Poses belong to packets of the same measuring
// time. If they arrive less than a second apart from these, their times stay. Reads on until the
// clocks are known, and whether a log has poses beside packets.
std::int64_t CarCapture::delay_of_poses(const DriveFiles& drive) {
  CaptureSet files(drive.captures);
  CarClocks clocks(*car_);
  NamedSenders senders(*car_);
  if (has_log_) {
    clocks.use_log(0);
  }
  const CarClocks::Span& packets = clocks.packets();
  std::int64_t delay_us = 0;
  const auto is_beside = [&] {
    const bool is_told = !has_log_ || drive.clock_offset_s;
    delay_us = found_us_ ? *found_us_
               : is_told ? clocks.poses_us() + offset_us_ - clocks.sensors_us()
                         : 0;
    return !has_log_ || (difference(poses_.front().time_us, packets.last_us) + delay_us <= 0 &&
                         difference(packets.first_us, poses_.back().time_us) - delay_us <= 0);
  };
  std::optional<CapturedDatagram> datagram;
  while (!(clocks.are_known() && is_beside()) && (datagram = files.next())) {
    const std::uint16_t port = datagram->destination.port;
    if (!senders.is_stranger(datagram->source.ipv4, port) &&
        !(has_log_ && is_pose_port(*car_, port))) {
      clocks.add(*datagram);
    }
  }
  if (!is_beside() && packets.last_us > 0) {
    std::ranges::for_each(poses_, [&clocks](const auto& pose) { clocks.add(pose); });
    std::string words = clocks.words_apart();
    if (drive.clock_offset_s) {
      words += "; with --clock-offset " + std::to_string(*drive.clock_offset_s) +
               " they have none either";
    }
    for (const std::string& left_out : log_words_) {
      words += left_out.starts_with("not used") ? "; " + left_out : "";
    }
    throw UsageError(drive.poses + ": " + words);
  }
  offset_us_ = found_us_ ? *found_us_ + clocks.sensors_us() : offset_us_;
  return std::abs(delay_us) < kSecondUs && !has_log_ ? 0 : delay_us;
}

void CarCapture::read_poses(const DriveFiles& drive) {
  CaptureSet files(drive.captures);
  while (std::optional<CapturedDatagram> datagram = files.next()) {
    if (is_pose_port(*car_, datagram->destination.port)) {
      poses_.push_back(*std::move(datagram));
    }
  }
}

void CarCapture::read_log(const DriveFiles& drive) {
  if (!vehicle::have_classes(car_->vehicle->grids)) {
    throw UsageError("--poses: " + std::string(car_->vehicle->name) +
                     " has no classes, so it has no use for poses; grids = \"classes\" or "
                     "\"both\" in a car's file asks for them");
  }
  const ConvertedLog poses = log_of(drive, *car_);
  log_words_ = words_of(poses, {});
  if (drive.finds_clock_offset) {
    const MotionOffset offset =
        offset_by_motion(motion_in(drive.captures, *car_, kEnoughMotionS), poses.samples);
    if (!offset.refusal.empty()) {
      throw UsageError(drive.poses + ": --clock-offset auto: " + offset.refusal);
    }
    found_us_ = std::llround(offset.seconds * 1e6);
    log_words_.push_back(words_of(offset));
  }
  PoseEncoder encoder;
  for (const PoseSample& sample : poses.samples) {
    poses_.push_back(encoder.datagram_of(sample));
    poses_.back().destination.port = car_->vehicle->poses.udp_port;
  }
}

std::optional<PcapReader::Place> CarCapture::place() const {
  return is_merged_ ? std::nullopt : files_.place();
}

void CarCapture::put_ahead(CapturedDatagram& pose) {
  auto [fate, message] = pose::decode(pose.payload);
  if ((offset_us_ == 0 && !has_log_) || fate != pose::Fate::kUsed) {
    return;
  }
  message.clock_us += static_cast<std::uint64_t>(offset_us_);
  const auto bytes = encoder_.encode(message);
  pose.payload.assign(bytes.begin(), bytes.end());
}

// Before the first packet and behind the last one a target needs no more of a log.
bool CarCapture::is_distant(std::uint64_t pose_us,
                            const std::optional<CapturedDatagram>& packet) const {
  const std::uint64_t last_us = clocks_.packets().last_us;
  return packet ? last_us == 0 && pose_us + pose::kLostUs < packet->time_us
                : pose_us > last_us + pose::kLostUs;
}

std::optional<CapturedDatagram> CarCapture::next() {
  std::optional<CapturedDatagram> datagram = std::exchange(packet_, std::nullopt);
  while (!datagram && (datagram = files_.next()) && is_left_out(*datagram)) {
    datagram.reset();
  }
  while (has_log_ && next_pose_ < poses_.size() &&
         is_distant(poses_[next_pose_].time_us, datagram)) {
    ++next_pose_;
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

std::string CarCapture::words_of_cover() const {
  const CarClocks::Span& packets = clocks_.packets();
  if (!has_log_ || packets.last_us == 0) {
    return {};
  }
  std::vector<std::string> missing;
  const auto note = [&missing](std::int64_t missing_us, const char* verb, const char* where) {
    std::ostringstream text;
    text << verb << std::fixed << std::setprecision(3) << static_cast<double>(missing_us) / 1e6
         << where;
    if (missing_us > kSecondUs) {
      missing.push_back(text.str());
    }
  };
  note(difference(poses_.front().time_us, packets.first_us), "begin ", " s after the first packet");
  note(difference(packets.last_us, poses_.back().time_us), "end ", " s before the last packet");
  if (missing.empty()) {
    return {};
  }
  return "the poses " + joined(missing, " and ") + ": packets there have no place" +
         (found_us_ ? "" : "; if the clocks differ, --clock-offset auto finds by how much");
}

std::string CarCapture::clock_words() const {
  std::vector<std::string> all{files_.words(),           clocks_.words(),  clocks_.words_of_pace(),
                               clocks_.words_of_crowd(), words_of_cover(), senders_.words()};
  std::erase(all, "");
  return joined(all, "; ");
}

std::vector<std::string> CarCapture::remarks() const {
  std::vector<std::string> remarks = log_words_;
  remark(unused_poses_, "pose|poses in the captures is|are not used", remarks);
  return remarks;
}

void warn_of(const DriveFiles& drive, const CarCapture& capture) {
  for (const CaptureSet::File& file : capture.files().files()) {
    warn_of(file.path, *file.reader);
  }
  for (const std::string& words : capture.remarks()) {
    std::cerr << "iog: " << drive.poses << ": " << words << '\n';
  }
  if (const std::string words = capture.clock_words(); !words.empty()) {
    std::cerr << "iog: " << drive.name() << ": " << words << '\n';
  }
}

}  // namespace iog::tools
