#include "tools/identity/car_capture.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <utility>

#include "pose/limits.hpp"
#include "tools/odometry/motion_offset.hpp"
#include "tools/poses/pose_encoder.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/fixed.hpp"
#include "tools/program/joined.hpp"

namespace iog::tools {
namespace {

constexpr std::int64_t kSecondUs = 1'000'000;
// For an offset by motion: two minutes have some bends.
constexpr double kEnoughMotionS = 120;

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
  PoseConversion conversion{
      .mount_x_m = at[0], .mount_y_m = at[1], .mount_yaw_rad = at[2] * kRadians};
  if (!drive.poses_sigma.empty()) {
    conversion.sigma_m = drive.poses_sigma[0] / 1000;
    conversion.sigma_heading_rad = drive.poses_sigma[1] / 1000;
  }
  return conversion;
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
    return !has_log_ ||
           (microseconds_later(poses_.front().time_us, packets.last_us) + delay_us <= 0 &&
            microseconds_later(packets.first_us, poses_.back().time_us) - delay_us <= 0);
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
  log_words_ = words_of(poses);
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
    if (missing_us > kSecondUs) {
      missing.push_back(verb + fixed(static_cast<double>(missing_us) / 1e6, 3) + where);
    }
  };
  note(microseconds_later(poses_.front().time_us, packets.first_us), "begin ",
       " s after the first packet");
  note(microseconds_later(packets.last_us, poses_.back().time_us), "end ",
       " s before the last packet");
  if (missing.empty()) {
    return {};
  }
  return "the poses " + joined(missing, " and ") + ": packets there have no place" +
         (found_us_ ? "" : "; if the clocks differ, --clock-offset auto finds by how much");
}

std::string CarCapture::time_words() const {
  std::vector<std::string> all{files_.words(), clocks_.words(), clocks_.words_of_pace(),
                               words_of_cover()};
  std::erase(all, "");
  return joined(all, "; ");
}

std::string CarCapture::clock_words() const {
  std::vector<std::string> all{time_words(), senders_.words()};
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
  std::vector<std::string> all = capture.words_of_lost();
  all.insert(all.begin(), {capture.clock_words(), capture.words_of_crowd()});
  for (const std::string& words : all) {
    if (!words.empty()) {
      std::cerr << "iog: " << drive.name() << ": " << words << '\n';
    }
  }
}

}  // namespace iog::tools
