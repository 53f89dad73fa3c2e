#include "tools/clouds/cloud_conversion.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>

#include "tools/poses/pose_log.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

CloudPoint moved(const Rigid& by, const CloudPoint& point) {
  const auto row = [&](std::size_t i) {
    return by[i] * point.x + by[i + 1] * point.y + by[i + 2] * point.z + by[i + 3];
  };
  return {row(0), row(4), row(8)};
}

constexpr std::uint64_t kPosePeriodUs = 10'000;

}  // namespace

CloudConversion::CloudConversion(const std::string& folder, const CatalogueEntry& car,
                                 std::size_t sensor, double mount_x_m, double mount_y_m)
    : car_(&car),
      sensor_(&car.sensors[sensor]),
      set_(read_cloud_set(folder)),
      head_(set_.forward, set_.times),
      track_(set_.poses),
      packets_(*sensor_, head_) {
  make_samples(mount_x_m, mount_y_m);
  if (set_.is_corrected && set_.poses.in_space.empty()) {
    set_.remarks.emplace_back(
        "no way back to where points were seen: each cloud is as of one time");
  }
  set_.remarks.insert(set_.remarks.end(), set_.poses.remarks.begin(), set_.poses.remarks.end());
}

// Poses of the unit become poses of the car by its mount.
void CloudConversion::make_samples(double mount_x_m, double mount_y_m) {
  if (track_.is_empty()) {
    return;
  }
  PoseLog even;
  even.poses = track_.every(kPosePeriodUs);
  PoseConversion conversion{.mount_x_m = mount_x_m, .mount_y_m = mount_y_m};
  if (set_.poses.is_of_unit) {
    conversion.mount_x_m = sensor_->mount.x_m;
    conversion.mount_y_m = sensor_->mount.y_m;
    conversion.mount_yaw_rad = sensor_->mount.yaw_deg * kRadians;
  }
  ConvertedLog log = converted(std::move(even), conversion);
  samples_ = std::move(log.samples);
  set_.remarks.insert(set_.remarks.end(), log.remarks.begin(), log.remarks.end());
}

// A point of a corrected cloud stood still while the unit moved on, or had not come so far: the
// unit's whole motion is taken back, as it pitches and rolls on a road.
CloudPoint CloudConversion::place_at(const CloudPoint& point, double time_us) const {
  if (set_.poses.in_space.empty()) {
    return point;
  }
  const auto time_of = [](const ForwardTime& its) { return static_cast<double>(its.time_us); };
  const auto after = std::ranges::upper_bound(set_.forward, time_us, {}, time_of);
  const auto to = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(after - set_.forward.begin(), 1, std::ssize(set_.forward) - 1));
  const double from_us = time_of(set_.forward[to - 1]);
  const double part = (time_us - from_us) / (time_of(set_.forward[to]) - from_us);
  const Rigid then = between(set_.poses.in_space[to - 1], set_.poses.in_space[to], part);
  return moved(inverse(then), moved(set_.poses.in_space[next_cloud_], point));
}

std::vector<CapturedDatagram> CloudConversion::next() {
  for (; next_cloud_ < set_.clouds.size(); ++next_cloud_) {
    if (set_.clouds[next_cloud_].empty()) {
      continue;
    }
    const ForwardTime& its = set_.forward[next_cloud_];
    std::vector<CapturedDatagram> packets = packets_.add(
        its.turn, read_cloud(set_.clouds[next_cloud_]),
        [this](const CloudPoint& point, double time_us) { return place_at(point, time_us); });
    ++clouds_read_;
    const std::uint64_t finite = fates().seen() - fates().not_finite;
    if (2 * packets_.sure() < finite) {
      throw UsageError(set_.clouds[next_cloud_] + ": only " + std::to_string(packets_.sure()) +
                       " of " + std::to_string(finite) + " points are where the lasers of " +
                       std::string(sensor_->name) + " look: the car's table is of another unit");
    }
    if (!packets.empty()) {
      ++next_cloud_;
      return with_poses(std::move(packets));
    }
  }
  if (std::exchange(is_over_, true)) {
    return {};
  }
  std::vector<CapturedDatagram> rest = with_poses(packets_.finish());
  add_poses_until(std::numeric_limits<std::uint64_t>::max(), rest);
  return rest;
}

void CloudConversion::add_poses_until(std::uint64_t time_us,
                                      std::vector<CapturedDatagram>& datagrams) {
  for (; next_sample_ < samples_.size() && samples_[next_sample_].time_us <= time_us;
       ++next_sample_) {
    datagrams.push_back(encoder_.datagram_of(samples_[next_sample_]));
    datagrams.back().destination.port = car_->vehicle->poses.udp_port;
  }
}

std::vector<CapturedDatagram> CloudConversion::with_poses(std::vector<CapturedDatagram> packets) {
  std::vector<CapturedDatagram> datagrams;
  for (CapturedDatagram& packet : packets) {
    add_poses_until(packet.time_us, datagrams);
    datagrams.push_back(std::move(packet));
  }
  return datagrams;
}

}  // namespace iog::tools
